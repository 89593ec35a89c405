# Clouds: as many spheres as asked for, in their region, apart, with the volume they should have; the same for a seed and
# another for another; the resolved case lists them and gives the same run; what does not fit says how many did.
set -eu
cat >cloud.yaml <<'END'
bulla: 1
title: A cloud
domain: {lower: [0, 0, 0], upper: [1 mm, 1 mm, 1 mm], cells: [64, 64, 64], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow, z-: outflow, z+: outflow}}
materials: {water: {eos: {type: stiffened-gas, preset: sg44}}, air: {eos: {type: ideal-gas, preset: air}}}
initial:
  - {everywhere: true, material: water, density: 998, pressure: 1 bar}
  - cloud: {within: {sphere: {center: [0.5 mm, 0.5 mm, 0.4 mm], radius: 0.35 mm}}, number: 40, radii: 40 um, spread: 0.2, largest: 70 um, gap: 5 um, seed: 7}
    material: air
    density: 1.2
    pressure: 1 bar
run: {until: 1 ns, max-steps: 1}
output: {directory: out, history: {every: 1 ns, columns: {V: {volume: air}, m: {mass: air}}}}
END
balls() { # CASE: x,y,z,radius of the spheres of the resolved case
    "$BULLA" show "$@" 2>/dev/null | awk -F '[][,: ]+' '$2 == "center" { at = $3 "," $4 "," $5 } $2 == "radius" { print at "," $3 }'
}
balls cloud.yaml >one
awk -F, '{ x[NR] = $1; y[NR] = $2; z[NR] = $3; r[NR] = $4; log_r += log($4); square += log($4)^2
        if ($4 > 70e-6 || ($4 > last && NR > 1)) { print "sizes: " $0; exit 1 }
        last = $4
        if (sqrt(($1 - 5e-4)^2 + ($2 - 5e-4)^2 + ($3 - 4e-4)^2) + $4 + 5e-6 > 3.5e-4 * (1 + 1e-12)) { print "outside: " $0; exit 1 }
        for (i = 1; i < NR; i++)
            if (sqrt((x[i] - $1)^2 + (y[i] - $2)^2 + (z[i] - $3)^2) < (r[i] + $4 + 5e-6) * (1 - 1e-12)) { print "overlap: " $0; exit 1 } }
    END { mean = log_r / NR; s = sqrt(square / NR - mean^2)
        if (NR != 40 || exp(mean) < 36e-6 || exp(mean) > 44e-6 || s < 0.13 || s > 0.27) { print NR, exp(mean), s; exit 1 } }' one
balls cloud.yaml >again
cmp one again
balls cloud.yaml --set 'initial[1].cloud.seed=8' >other
! cmp -s one other

balls cloud.yaml --set 'initial[1].cloud.gap=50 um' --set 'initial[1].cloud.number=15' >one
# The gas of a run is that of its spheres (but where two share a cell), and the resolved case is the same case.
"$BULLA" run cloud.yaml --set 'initial[1].cloud.gap=50 um' --set 'initial[1].cloud.number=15' --set domain.cells='[32, 32, 32]' --quiet
awk -F, 'FILENAME == "one" { V += 4 / 3 * 3.14159265358979 * $4^3 } FNR == 2 && FILENAME != "one" { d = $4 / V - 1; if (d > 1e-5 || d < -1e-5) { print $4, V; exit 1 } }' \
    one out/history.csv
"$BULLA" run out/case.yaml -o resolved --quiet
cmp out/history.csv resolved/history.csv

# By void fraction, in the plane.
sed 's/lower: \[0, 0, 0\], upper: \[1 mm, 1 mm, 1 mm\], cells: \[64, 64, 64\]/lower: [0, 0], upper: [1 mm, 1 mm], cells: [256, 256]/; s/, z-: outflow, z+: outflow//; s/cloud: .*/cloud: {within: {box: {lower: [0, 0.2 mm], upper: [1 mm, 0.8 mm]}}, void-fraction: 0.1, radii: 15 um}/' cloud.yaml >plane.yaml
"$BULLA" run plane.yaml -o plane --quiet
awk -F, 'NR == 2 { d = $4 / 0.6e-6; if (d < 0.0993 || d > 0.1007) { print d; exit 1 } }' plane/history.csv

refused() { # WORDS CASE SETTING
    if "$BULLA" check "$2" --set "$3" >said 2>&1; then cat said; exit 1; fi
    grep -q -e "$1" said || { cat said; exit 1; }
}
refused 'only [0-9]* of 900 spheres fit' cloud.yaml 'initial[1].cloud={within: {sphere: {center: [0.5 mm, 0.5 mm, 0.4 mm], radius: 0.35 mm}}, number: 900, radii: 40 um}'
refused 'only 0 of 1 spheres fit' cloud.yaml 'initial[1].cloud={within: {box: {lower: [0, 0, 0], upper: [10 um, 10 um, 10 um]}}, number: 1, radii: 40 um}'
grep -q ': 1 error;' said || { cat said; exit 1; } # and nothing else
refused "one of 'number' and 'void-fraction'" cloud.yaml 'initial[1].cloud.void-fraction=0.1'
refused 'one sphere is more than that' plane.yaml 'initial[1].cloud.void-fraction=1e-9'
refused 'is less than .smallest' cloud.yaml 'initial[1].cloud.smallest=80 um'
refused 'one shape is enough' cloud.yaml 'initial[1].box={lower: [0, 0, 0], upper: [1 mm, 1 mm, 1 mm]}'
refused 'needs a cartesian domain' plane.yaml 'domain={geometry: axisymmetric, lower: [0, 0], upper: [1 mm, 1 mm], cells: [64, 64], boundaries: {x-: axis, x+: outflow, y-: outflow, y+: outflow}}'

# Rows and lattices: what they stand for, to the byte.
cat >row.yaml <<'END'
bulla: 1
title: A row
parameters: {R: 0.04, n: 3}
domain: {lower: [0, 0], upper: [1, 1], cells: [64, 64], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}
materials: {air: {eos: {type: ideal-gas, preset: air}}, helium: {eos: {type: ideal-gas, preset: helium}}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1 atm}
  - {repeat: {i: = n - 1, j: [1, 2]}, sphere: {center: [= 0.25 + 0.5 * i, = 0.3 * j], radius: = R * j}, material: helium, density: = 0.16 + 0.01 * i, pressure: 1 atm}
run: {until: 1 us}
output: {directory: rows}
END
sed '/repeat/d' row.yaml >by-hand.yaml
for i in 0 1; do
    for j in 1 2; do
        printf '  - {sphere: {center: [= 0.25 + 0.5 * (%s), = 0.3 * (%s)], radius: = R * (%s)}, material: helium, density: = 0.16 + 0.01 * (%s), pressure: 1 atm}\n' $i $j $j $i
    done
done >layers
sed -i '/everywhere/r layers' by-hand.yaml
sed -i 's/, n: 3//' by-hand.yaml
"$BULLA" show row.yaml >row.txt
"$BULLA" show by-hand.yaml >by-hand.txt
grep -c sphere: row.txt | grep -qx 4
diff row.txt by-hand.txt
refused 'takes no value at all' row.yaml 'initial[1].repeat.i=0'
refused "'R' is a parameter already" row.yaml 'initial[1].repeat={R: 2}'
refused "'x' cannot be the name" row.yaml 'initial[1].repeat={x: 2}'
refused 'a whole number is needed' row.yaml 'initial[1].repeat.i=2.5'
refused 'more than 10000 layers' row.yaml 'initial[1].repeat.i=20000'
