# One traction in the plane and in space: a bubble in a stretched gel, with levels and what moves across ranks. The same bits on 1,
# 2 and 3 ranks and after a restart; mass and energy to round-off; a surface along the mesh rests, which one pressure shakes. A
# stone that flies through air is not sheared by it.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >gel.yaml <<'END_GEL'
bulla: 1
title: A bubble in a stretched gel
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8, levels: 1, refine: [{interface: air, where: {half-space: {point: [0.5, 0], normal: [1, 0]}}}]}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, constitutive: {type: neo-hookean, shear-modulus: 2 MPa, reference-density: 1000}}
initial:
  - {everywhere: true, material: gel, density: 1000, pressure: 5 MPa, velocity: [20, 10], stretch: [1.2, 0.9, 1]}
  - {sphere: {center: [0.5, 0.4], radius: 0.2}, material: air, density: 20, pressure: 8 MPa, velocity: [20, 10]}
scheme: {traction: common}
run: {until: 1 s, max-steps: 30}
output:
  directory: out
  checkpoints: {every: 10 steps}
  history: {columns: {m: {mass: gel}, M: {mass: air}, E: {total: energy}}}
expect:
  - {value: "abs(last(m)/first(m) - 1)", at-most: 1e-12}
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-12}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-12}
END_GEL
ranked gel 1 2 3
resumed gel 10 gel-1

"$BULLA" plan gel.yaml >plan
grep -q '^  normal .*core/scheme/normal.c' plan || fail 'the plan has no normals' plan
"$BULLA" plan gel.yaml --set scheme.traction=pressure >plain
! grep -q normal.c plain || fail 'normals that nobody asked for' plain

# Stripes of stretched gel and gas under 45 degrees rest to round-off, with normals and shear in every cell of a surface; under
# 63 degrees as well as they do.
cat >stripes.yaml <<'END_STRIPES'
bulla: 1
title: Stripes at rest
domain: {lower: [0, 0], upper: [1, 1], cells: [24, 24], boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic}}
materials:
  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 616576970.0}, constitutive: {type: neo-hookean, shear-modulus: 2 MPa, reference-density: 1060}}
  gas: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: gas, density: 10, pressure: 10 MPa, velocity: [0, 0]}
  - union:
      - {intersection: [{half-space: {normal: [1, 1], point: [0.253, 0]}}, {half-space: {normal: [-1, -1], point: [0.753, 0]}}]}
      - {intersection: [{half-space: {normal: [1, 1], point: [1.253, 0]}}, {half-space: {normal: [-1, -1], point: [1.753, 0]}}]}
    material: gel
    density: 1060
    pressure: 12111111.111111112
    velocity: [0, 0]
    stretch: {xx: 1.158248290463863, yy: 1.158248290463863, zz: 0.816496580927726, xy: 0.341751709536137}
scheme: {traction: common}
run: {until: 1 s, max-steps: 40}
output:
  directory: out
  history: {columns: {u: {max: "= math.sqrt(velocity_x^2 + velocity_y^2)"}}}
expect:
  - {value: "max(u)", at-most: 1e-8}
END_STRIPES
"$BULLA" run stripes.yaml --quiet

# A gel that is squeezed and bears -12 bar beside gas of 2 bar rests as well.
sed -e 's/density: 10, pressure: 10 MPa/density: 2, pressure: 0.2 MPa/; s/directory: out/directory: squeezed/' \
    -e 's|^    pressure: .*|    pressure: = 0.2e6 + 2e6*(4/9 - (4/9 + 3)/3)|' \
    -e 's|^    stretch: .*|    stretch: {xx: = (2/3 + math.sqrt(1.5))/2, yy: = (2/3 + math.sqrt(1.5))/2, zz: = math.sqrt(1.5), xy: = (2/3 - math.sqrt(1.5))/2}|' \
    stripes.yaml >squeezed.yaml
"$BULLA" run squeezed.yaml --quiet

# A disc of stone rests in air, with the limiter that it has there by itself; in water it keeps its sharp surface. So it
# does with a sharp one, as what lies at the faces of its cells does not strain it; else it shakes.
sed -e 's/^title: .*/title: A stone in air/; s/cells: \[24, 24\]/cells: [32, 32]/' -e '/^materials:/,$d' stripes.yaml >stone.yaml
cat >>stone.yaml <<'END_STONE'
materials:
  stone: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 5 GPa, cv: 2451}, constitutive: {type: neo-hookean, shear-modulus: 5 GPa, reference-density: 2000}}
  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}}
initial:
  - {everywhere: true, material: air, temperature: 300, pressure: 65 kPa}
  - {sphere: {center: [0.5, 0.5], radius: 0.2}, material: stone, temperature: 300, pressure: 65 kPa}
run: {until: 1 s, max-steps: 60}
output: {history: {columns: {u: {max: "= math.sqrt(velocity_x^2 + velocity_y^2)"}}}}
expect:
  - {value: "max(u)", at-most: 1e-8} # 1e-9 with superbee
END_STONE
"$BULLA" run stone.yaml --quiet
"$BULLA" run stone.yaml --quiet --overwrite --set scheme.interface-limiter=superbee 2>said || fail 'a sharp stone shakes' said
! "$BULLA" run stone.yaml --quiet --overwrite --set scheme.interface-limiter=superbee --set scheme.surface-strain=face \
    >said 2>&1 || fail 'a sharp stone rests though the air strains it'
"$BULLA" check stone.yaml | grep -q 'interface  *limiter:van-albada' || fail 'a stone in air has sharp surfaces'
"$BULLA" check stone.yaml --set scheme.interface-limiter=koren 2>&1 | grep -q "'koren' a stiff solid that moves" || fail 'no warning'
"$BULLA" check stone.yaml --set 'materials.air.eos={type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa, cv: 590}' |
    grep -q 'interface  *limiter:superbee' || fail 'a stone in water has blunt surfaces'

# In flight its surface bears no shear: with what the one velocity of mixed cells shears it by, 303 m/s, in space 530, soon.
cat >flight.yaml <<'END_FLIGHT'
bulla: 1
title: A stone flies through air
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic}}
mesh: {tile: 8, levels: 1, refine: [{interface: stone}]}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  stone: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 6 GPa}, constitutive: {type: neo-hookean, shear-modulus: 5 GPa, reference-density: 2000}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 65 kPa}
  - {sphere: {center: [0.5, 0.5], radius: 0.12}, material: stone, density: 2000, pressure: 65 kPa, velocity: [60, 0]}
run: {until: 1 s, max-steps: 60}
output:
  checkpoints: {every: 20 steps}
  history: {every: 1 steps, columns: {u: {max: "= math.sqrt(velocity_x^2+velocity_y^2)"}, m: {mass: stone}, E: {total: energy}, P: {total: momentum_x}}}
expect:
  - {value: "max(u)", at-most: 80} # 67.9
  - {value: "max(abs(m/first(m) - 1))", at-most: 1e-12}
  - {value: "max(abs(E/first(E) - 1))", at-most: 1e-12}
  - {value: "max(abs(P/first(P) - 1))", at-most: 1e-12}
END_FLIGHT
ranked flight 1 2 3
resumed flight 20 flight-1
"$BULLA" plan flight.yaml >plan
grep -q '^  slip .*core/scheme/slip.c' plan || fail 'the plan has no slip' plan
"$BULLA" plan flight.yaml --set scheme.surface-shear=kept >plan
! grep -q slip.c plan || fail 'slip that nobody asked for' plan
grep -q '^  shelter .*core/scheme/shelter.c' plan || fail 'the plan has no shelter' plan
"$BULLA" plan flight.yaml --set scheme.surface-strain=face >plan
! grep -q shelter.c plan || fail 'shelter that nobody asked for' plan
"$BULLA" plan stone.yaml --set 'materials.stone.constitutive.shear-modulus=1 MPa' >plan
! grep -q shelter.c plan || fail 'shelter of a soft solid' plan
"$BULLA" plan stone.yaml --set 'materials.stone.constitutive.shear-modulus=1 MPa' \
    --set 'materials.stone.viscoelastic=[{shear-modulus: 5 GPa, relaxation-time: 1 s}]' >plan
grep -q shelter.c plan || fail 'no shelter of a stiff branch' plan
"$BULLA" plan stone.yaml --set scheme.closure=allaire --set scheme.surface-strain=share >plan 2>said
! grep -q shelter.c plan || fail 'shelter with allaire' plan
grep -q "warning: 'surface-strain: share' goes with 'closure: kapila', and has no effect here" said || fail 'with allaire' said
sed -e 's/upper: \[1, 1\]/upper: [1, 1, 1]/; s/\[0, 0\]/[0, 0, 0]/; s/\[32, 32\]/[16, 16, 16]/; s/y+: periodic}/y+: periodic, z-: periodic, z+: periodic}/' \
    -e 's/\[0.5, 0.5\], radius: 0.12/[0.5, 0.5, 0.5], radius: 0.22/; s/\[60, 0\]/[60, 0, 0]/; s/at-most: 80/at-most: 120/' flight.yaml >space.yaml # 98.7
"$BULLA" run space.yaml --quiet

"$BULLA" run "$BULLA_SOURCE/cases/verify/rest-gel.yaml" --variant quick -o rest-gel --quiet
"$BULLA" run "$BULLA_SOURCE/cases/verify/rest-stiff.yaml" --variant quick -o rest-stiff --quiet
# Faces of slow flow, too, are the same to a tile of one material and to a mixed one: energy stays.
"$BULLA" run "$BULLA_SOURCE/cases/verify/rest-slow.yaml" --variant quick -o rest-slow --quiet

# A sheared solid that slides along water (e05) is set in motion in the plane as in one dimension: faces that lie in the surface
# take the shear of the solid as it is. With the part of the hoop stress the water gets 4 % too much.
slide() { # NAME DIM: the speed of the water near the surface
    sed -e "s/NAME/$1/" -e "$2" >"$1.yaml" <<'END_SLIDE'
bulla: 1
title: A sheared solid beside water
domain: {lower: [-0.5], upper: [0.5], cells: [100], velocity-components: 2, boundaries: {x-: outflow, x+: outflow}}
materials:
  solid:
    eos: {type: stiffened-gas, gamma: 3.4, p-inf: 4591545000}
    constitutive: {type: neo-hookean, shear-modulus: 10728633195, reference-density: 1995}
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
initial:
  - {everywhere: true, material: water, density: 998.2, pressure: 100000, velocity: [0, 0]}
  - {half-space: {normal: [-1], point: [0]}, material: solid, density: 1995, pressure: 100000, velocity: [0, 0],
     stretch: {xx: 0.9950371902099893, yy: 1.014937934014189, xy: 0.09950371902099893}}
scheme: {limiter: mc, integrator: midpoint, cfl: 0.4}
run: {until: 1e-4}
output:
  directory: NAME
  probes: {every: 10 steps, water: {at: [0.02], fields: [velocity]}}
END_SLIDE
    "$BULLA" run "$1.yaml" --quiet
    tail -n 1 "$1/probes.csv" | cut -d, -f2
}
line=$(slide line 's/^//')
plane=$(slide plane 's/\[-0.5\]/[-0.5, 0]/; s/\[0.5\]/[0.5, 0.04]/; s/\[100\]/[100, 4]/; s/velocity-components: 2, //
    s/x+: outflow/&, y-: periodic, y+: periodic/; s/normal: \[-1\], point: \[0\]/normal: [-1, 0], point: [0, 0]/
    s/\[0.02\]/[0.02, 0.01]/')
awk -v a="$line" -v b="$plane" 'BEGIN { exit !(a > 1 && b/a > 0.995 && b/a < 1.005) }' || fail "u of the water: $line, $plane"

# Across a surface a solid is strained as its volume changes, whatever comes to the faces: around a centre, where nothing
# lies askew, the strain is the same, and the hoop with it.
for strain in face share; do
    "$BULLA" run "$BULLA_SOURCE/cases/verify/es1.yaml" --variant quick -o "hoop-$strain" --max-steps 300 --quiet \
        --set scheme.surface-strain=$strain >said 2>&1 || [ $? = 1 ] || fail "es1 with $strain" said # its bounds: of all of it
    tail -n 1 "hoop-$strain/history.csv" >>hoops
done
tr , ' ' <hoops | awk 'NR == 1 { split($0, face) } NR == 2 { for (i = 1; i <= NF; i++) {
    gap = $i - face[i]; if (gap < 0) gap = -gap; if (gap > 1e-9 * face[i]) exit 1 } } END { if (NR != 2 || $8 < 1.05) exit 1 }' ||
    fail 'the hoop of solids that do not come to the faces' hoops

# What has no effect is said before the run.
for key in traction=pressure surface-shear=free surface-strain=share; do
    "$BULLA" check "$BULLA_SOURCE/cases/tour/tube.yaml" --set scheme.$key >said 2>&1 || fail "check with $key" said
    grep -q "warning: '${key%=*}' says how elastic solids meet fluids, and has no effect here" said || fail "$key is idle" said
    "$BULLA" check "$BULLA_SOURCE/cases/tour/stone.yaml" --set scheme.$key >said 2>&1 || fail "check of stone with $key" said
    ! grep -q 'has no effect here' said || fail "$key has an effect" said
done
