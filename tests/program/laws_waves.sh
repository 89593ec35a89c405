# Every built-in elastic law in a bar stretched by a half: a weak shear pulse and a weak pressure pulse travel at the
# speeds that theory gives for small motions on the stretched state,
#     c_S^2 = 2 l_x^2 (e_1 + l_z^2 e_2),   c_L^2 = c_h^2 + (1/rho) d s'_xx/d eps,
# the second from differences of the stress s' = 2 rho ((e_1 + I1 e_2) dev B - e_2 dev B^2) under a further stretch
# eps in x alone; c_h is that of the pressure (Truesdell & Noll, The Non-Linear Field Theories of Mechanics, 1965, 71-77).
set -eu
cat >bar.yaml <<'CASE'
bulla: 1
title: A pulse in a stretched bar
parameters: {c: 1 km/s, along: 0.1, across: 0}
domain:
  geometry: cartesian
  lower: [0]
  upper: [1 m]
  cells: [160]
  velocity-components: 2
  boundaries: {x-: outflow, x+: outflow}
materials:
  bar:
    eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}
    constitutive: {type: neo-hookean, shear-modulus: 1 GPa, reference-density: 1000 kg/m3}
initial:
  - everywhere: true
    material: bar
    density: 1000
    pressure: 1e5
    stretch: [1.5, 0.81649658092772603, 0.81649658092772603]
    velocity: ["= along * math.exp(-((x - 0.5)/0.05)^2)", "= across * math.exp(-((x - 0.5)/0.05)^2)"]
run: {until: = 0.45 / c}
output:
  directory: out
  history: {every: 1 step, columns: {energy: {total: energy}}}
  probes: {right: {at: [0.75], fields: [velocity]}}
expect:
  - {value: "mean(t * (right.velocity_x + right.velocity_y)) / mean(right.velocity_x + right.velocity_y) * c",
     label: "way of the pulse, m", equals: 0.25, relative: 2e-3}
CASE

# Both speeds from the first derivatives of the law's energy, written out here once more.
speeds() { # LAW OWN-NUMBER
    awk -v law="$1" -v own="$2" '
        function slopes(I1,    J) {
            J = I1 - 3
            e2 = law == "mooney-rivlin" ? own / 2 : 0
            e1 = law == "mooney-rivlin" ? (1 - own) / 2 : law == "gent" ? 0.5 / (1 - J / own) : law == "fung" ? exp(own * J) / 2 : law == "quadratic" ? 0.5 * (1 + own * J) : 0.5
            e1 *= 1e6; e2 *= 1e6
        }
        function stress(eps,    bx, bt, I1) { # per density of the bar before eps
            bx = 2.25 * (1 + eps) ^ (4 / 3)
            bt = (1 + eps) ^ (-2 / 3) / 1.5
            I1 = bx + 2 * bt
            slopes(I1)
            return 2 / (1 + eps) * ((e1 + I1 * e2) * (bx - I1 / 3) - e2 * (bx ^ 2 - (bx ^ 2 + 2 * bt ^ 2) / 3))
        }
        BEGIN {
            slopes(2.25 + 2 / 1.5)
            shear = sqrt(2 * 2.25 * (e1 + e2 / 1.5))
            along = sqrt(4.4 * 6.001e5 + (stress(1e-5) - stress(-1e-5)) / 2e-5)
            printf "%.10g %.10g\n", shear, along
        }'
}

pulse() { # LAW KEYS C ALONG ACROSS
    "$BULLA" run bar.yaml --overwrite --quiet --set parameters.c="$3" --set parameters.along="$4" --set parameters.across="$5" \
        --set materials.bar.constitutive="{type: $1, shear-modulus: 1 GPa, reference-density: 1000 kg/m3$2}" || {
        echo "$1: wave speed is not $3 m/s (along $4, across $5)"
        exit 1
    }
}

for law in neo-hookean: mooney-rivlin:ratio=0.5 gent:limit=1 fung:stiffening=2 quadratic:stiffening=2; do
    name=${law%%:*} keys=${law#*:}
    set -- $(speeds "$name" "${keys#*=}")
    keys=${keys:+, ${keys%=*}: ${keys#*=}}
    pulse "$name" "$keys" "$1" 0 0.1
    pulse "$name" "$keys" "$2" 0.1 0
    echo "$name: $1 and $2 m/s"
done

# The check is sharp enough to tell laws apart that differ by one part in a hundred of the speed.
set -- $(speeds fung 2.04)
"$BULLA" run bar.yaml --overwrite --quiet --set parameters.c="$1" --set parameters.along=0 --set parameters.across=0.1 \
    --set materials.bar.constitutive="{type: fung, shear-modulus: 1 GPa, reference-density: 1000 kg/m3, stiffening: 2}" &&
    { echo "another law would pass"; exit 1; }
exit 0
