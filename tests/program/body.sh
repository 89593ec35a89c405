# Shapes from files: an image, an array, a closed surface, rotated, extruded, cut out of each other. A run has their volumes
# and does not depend on ranks; the resolved case names the files and gives the same run; broken files are refused at their
# place in the case.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cp "$BULLA_SOURCE"/tests/data/body/* .
cat >plane.yaml <<'CASE'
bulla: 1
title: Bodies in the plane
domain: {lower: [-10 mm, -10 mm], upper: [30 mm, 10 mm], cells: [64, 32], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}
mesh: {tile: 16}
materials: {water: {eos: {type: stiffened-gas, preset: sg44}}, a: {eos: {type: ideal-gas, preset: air}}, b: {eos: {type: ideal-gas, preset: air}}}
initial:
  - {everywhere: true, material: water, density: 998, pressure: 1 bar}
  - {image: {file: oval.png, lower: [-10 mm, -10 mm], upper: [10 mm, 10 mm]}, material: a, density: 1.2, pressure: 1 bar}
  - difference:
      - {array: {file: distance.npy, lower: [10 mm, -10 mm], upper: [30 mm, 10 mm]}}
      - {rotated: {shape: {box: {lower: [20 mm, -1 mm], upper: [40 mm, 1 mm]}}, about: [20 mm, 0], angle: 210 deg}}
    material: b
    density: 1.2
    pressure: 1 bar
run: {until: 1 us, max-steps: 4}
output: {directory: out, history: {columns: {A: {volume: a}, B: {volume: b}, low: {volume: b, where: {half-space: {point: [0, 0], normal: [0, -1]}}}}}, snapshots: {every: 1 us, fields: [density]}}
CASE
cat >space.yaml <<'CASE'
bulla: 1
title: Bodies in space
domain: {lower: [-12 mm, -12 mm, -12 mm], upper: [12 mm, 12 mm, 12 mm], cells: [16, 16, 16], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow, z-: outflow, z+: outflow}}
mesh: {tile: 8}
materials: {water: {eos: {type: stiffened-gas, preset: sg44}}, a: {eos: {type: ideal-gas, preset: air}}, b: {eos: {type: ideal-gas, preset: air}}}
initial:
  - {everywhere: true, material: water, density: 998, pressure: 1 bar}
  - {surface: {file: octahedron.stl, scale: 0.5 mm, center: [-3 mm, -3 mm, -3 mm]}, material: a, density: 1.2, pressure: 1 bar}
  - extruded: {shape: {image: {file: oval.png, lower: [2 mm, 2 mm], upper: [10 mm, 10 mm]}}, from: -9 mm, to: 9 mm}
    material: b
    density: 1.2
    pressure: 1 bar
run: {until: 1 us, max-steps: 2}
output: {directory: out, history: {columns: {A: {volume: a}, B: {volume: b}}}}
CASE
sed -i "s|file: |file: $PWD/|" plane.yaml space.yaml # runs have copies of them elsewhere
near() { # FILE COLUMN VALUE PART: the first row
    awk -F, -v column="$2" -v value="$3" -v part="$4" '/^#/ { next } !head { for (i = 1; i <= NF; i++) if ($i ~ "^" column) at = i; head = 1; next }
        { d = $at / value - 1; if (d > part || d < -part || !at) { print column, $at, "not", value; exit 1 } exit }' "$1"
}
ranked plane 1 3
ranked space 1 2
# pi 8 4 mm2; pi 25 less the half strip, sqrt(24) + 25 asin(1/5): between values 0.6 mm apart a circle of 5 mm loses 0.3 %.
near plane-1/out/history.csv A 1.00531e-4 2e-3
near plane-1/out/history.csv B 6.86069e-5 4e-3
# Below the middle lies all of the strip but a triangle, sqrt(3)/2: it turned counterclockwise.
near plane-1/out/history.csv low 3.0203e-5 1e-2
near space-1/out/history.csv A 1.6666667e-7 1e-6
near space-1/out/history.csv B 2.8953e-7 2e-2
# Turned, a surface is as exact as it was; a cross-section is as exact as its image.
ran turned space --set 'initial[1]={rotated: {shape: {surface: {file: ../octahedron.stl, scale: 0.5 mm}}, angle: 0.3, axis: [1, 2, 3], about: [1 mm, 0, 0]}, material: a, density: 1.2, pressure: 1 bar}'
near turned/out/history.csv A 1.6666667e-7 1e-6
# The resolved case.
"$BULLA" run plane-1/out/case.yaml -o resolved --quiet
cmp resolved/history.csv plane-1/out/history.csv

refused() { # CASE SETTING WORDS
    code=0
    "$BULLA" check "$1.yaml" --set "$2" >said 2>&1 || code=$?
    [ "$code" = 2 ] && grep -qF -- "$3" said || fail "exit $code, and nothing of '$3'" said
}
sed 3,9d octahedron.stl >open.stl # one triangle less
refused space 'initial[1].surface.file=open.stl' "belong to one triangle alone"
refused space 'initial[1].surface.file=oval.png' 'no STL file'
refused space 'initial[1].surface.file=missing.stl' 'missing.stl cannot be read: No such file'
refused plane 'initial[1]={surface: {file: octahedron.stl, scale: 1 mm}, material: a, density: 1.2, pressure: 1 bar}' 'a surface needs three axes'
refused plane 'initial[1].image.file=octahedron.stl' 'octahedron.stl is no image'
refused plane 'initial[1].image.threshold=0' 'none of its values are inside'
"$BULLA" check plane.yaml --set 'initial[1].image.upper=[10 mm, 0]' >said 2>&1
grep -q 'is stretched' said && grep -qF "'upper: [0.01 m, 0.01 m]'" said || fail "nothing of stretched pixels" said
! "$BULLA" check plane.yaml 2>&1 | grep stretched
refused plane 'initial[1].image.upper=[1 cm]' '2 numbers are needed, not 1'
refused plane 'initial[1].image.upper=[-1 cm, 1 cm]' 'is not above the lower end'
refused plane 'initial[2].difference[0].array.file=oval.png' 'no file of NumPy'
refused plane 'initial[2].difference[1].rotated.axis=[1, 0]' 'turn about its normal alone'
refused space 'initial[2].extruded.to=-10 mm' 'is not above the lower end'
refused space 'initial[2].extruded.shape={sphere: {center: [0, 0, 0], radius: 1 mm}}' 'a polygon or an image is extruded'
