# A reconstruction with three layers of neighbours: the same bits on 1, 2 and 3 ranks with levels that move in the plane,
# around the axis and in space; taken up again from a checkpoint; a failed step and its replay. A tile that is too small for it
# is refused. A scheme from outside the tree that takes all components at once.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

materials='materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}'
scheme='scheme: {reconstruction: {type: weno5-z, fractions: weno}}'
output='output:
  snapshots: {every: 100 steps, fields: [density, velocity, pressure, alpha_air, level], precision: double}
  checkpoints: {every: 5 steps, keep: 9}
  history: {every: 1 step, columns: {V: {volume: air}, pmax: {max: pressure}, E: {total: energy}, M: {total: mass}}}'

cat >plane.yaml <<END2
bulla: 1
title: A blast and a bubble in a moving liquid
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, y-: reflecting, y+: non-reflecting}}
mesh: {levels: 2, tile: 8, regrid-every: 2, buffer: 2, patience: 1, refine: [{jump: alpha_water, above: 0.1}, {jump: pressure, above: 0.5}]}
$materials
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: [200, 50]}
  - {sphere: {center: [0.3, 0.5], radius: 0.15}, material: water, density: 1100, pressure: 3e8}
  - {sphere: {center: [0.7, 0.6], radius: 0.12}, material: air, density: 1.2, pressure: 1e5, velocity: [200, 50]}
$scheme
run: {until: 1, max-steps: 12}
$output
END2

cat >round.yaml <<END2
bulla: 1
title: A bubble near the axis, and a wave
domain:
  geometry: axisymmetric
  lower: [0, -1 mm]
  upper: [1 mm, 1 mm]
  cells: [32, 64]
  boundaries:
    x-: axis
    x+: {type: inflow, material: water, density: 1000, pressure: 1 bar, velocity: [-1, 0]}
    y-: no-slip
    y+: {type: incoming-wave, pulse: sine, amplitude: 20 MPa, frequency: 1 MHz}
mesh: {levels: 1, tile: 16, regrid-every: 2, buffer: 2, patience: 1, refine: [{jump: alpha_air, above: 0.2}]}
$materials
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1 bar, velocity: [0, 200]}
  - {sphere: {center: [0, -0.2 mm], radius: 0.4 mm}, material: air, density: 1.2, pressure: 1 bar, velocity: [0, 200]}
scheme: {reconstruction: weno5-z}
run: {until: 1, max-steps: 12}
$output
END2

cat >space.yaml <<END2
bulla: 1
title: A bubble and a wave in 3D
domain:
  lower: [-1 mm, -1 mm, -1 mm]
  upper: [1 mm, 1 mm, 1 mm]
  cells: [16, 16, 16]
  boundaries: {x-: outflow, x+: non-reflecting, y-: periodic, y+: periodic, z-: reflecting, z+: outflow}
mesh: {levels: 1, tile: 8, regrid-every: 2, buffer: 2, patience: 1, refine: [{jump: alpha_air, above: 0.2}]}
$materials
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1 bar, velocity: [0, 200, 0]}
  - {half-space: {point: [-0.6 mm, 0, 0], normal: [-1, 0, 0]}, material: water, density: 1010, pressure: 300 bar, velocity: [0, 200, 0]}
  - {sphere: {center: [-0.3 mm, 0.1 mm, -0.2 mm], radius: 0.3 mm}, material: air, density: 1.2, pressure: 1 bar, velocity: [0, 200, 0]}
scheme: {reconstruction: weno5-z}
run: {until: 1, max-steps: 6}
$output
END2

while read -r name all; do
    # shellcheck disable=SC2086
    ranked "$name" $all
    grep -q '"name": *"weno5-z"' "$name-1/out/provenance.json" || fail "$name: another scheme"
done <<END2
plane 1 2 3
round 1 3
space 1 2
END2
grep -q '"regrids": *[1-9]' plane-1/out/provenance.json || { echo "levels do not move"; exit 1; }
[ "$(sed -n '$p' plane-1/out/history.csv | cut -d, -f1)" = 12 ] || { echo "plane: not all steps"; exit 1; }

# It is another scheme than the default, on the same case.
"$BULLA" run plane.yaml -o default --set scheme.reconstruction=muscl --quiet
cmp -s plane-1/out/history.csv default/history.csv && { echo "nothing has changed"; exit 1; }

# Taken up again, on another number of ranks.
cp -r plane-1 again
rm again/out/checkpoints/*_000010.chk
(cd again && "$BULLA" run plane.yaml -o out --restart -n 2 --quiet </dev/null) >out 2>&1 || fail "it is not taken up again" out
cmp plane-1/out/history.csv again/out/history.csv

# A step that fails: streams that part, and its replay.
cat >parting.yaml <<END2
bulla: 1
title: Streams that part
domain: {lower: [-1, -1], upper: [1, 1], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, y-: reflecting, y+: reflecting}}
mesh: {tile: 16}
$materials
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: ['= x > 0.3 and 300 or -300', 10]}
  - {sphere: {center: [0.3, 0.1], radius: 0.21}, material: air, density: 1, pressure: 1e5}
scheme: {reconstruction: weno5-z, cfl: 0.9, guard: strict}
run: {until: 1, max-steps: 100}
output: {directory: parting}
END2
"$BULLA" run parting.yaml >out 2>&1 && fail "the step did not fail" out
"$BULLA" info --replay parting/dump_*.h5 >out 2>&1 || fail "the replay gives something else" out
grep -q 'the same, to the bit' out || fail "the replay says nothing" out

# Halves of a tile must hold three layers.
code=0
"$BULLA" check plane.yaml --set mesh.tile=4 >out 2>&1 || code=$?
[ $code = 2 ] && grep -q 'a side of at least 6' out || fail "a tile of 4 was accepted" out
"$BULLA" check plane.yaml --set mesh.tile=4 --set scheme.reconstruction=muscl >out 2>&1 || fail "two layers fit" out

# From outside the tree, with all components at once: a sharper interface.
cmake -G Ninja -S "$BULLA_SOURCE/tests/plugin" -B plugin -Dbulla_DIR="$BULLA_SOURCE/core/include/bulla" >out 2>&1 &&
    cmake --build plugin >>out 2>&1 || fail "the plugin does not build" out
"$BULLA" module check plugin/reconstruction-thinc.so >out 2>&1 || fail "thinc does not hold" out
cat >contact.yaml <<END2
bulla: 1
title: A bubble is carried along
modules: [./plugin/reconstruction-thinc.so]
domain: {lower: [0], upper: [1], cells: [64], boundaries: {x-: periodic, x+: periodic}}
$materials
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: [100]}
  - {box: {lower: [0.3], upper: [0.6]}, material: air, density: 1.2, pressure: 1e5, velocity: [100]}
scheme: {reconstruction: thinc, interface-limiter: minmod}
run: {until: 0.01}
output:
  directory: thinc
  snapshots: {every: 0.01, fields: [alpha_air]}
  history: {columns: {low: {min: pressure}, high: {max: pressure}, V: {volume: air}}}
expect:
  - {norm: L1, field: alpha_air, reference: initial, at-most: 0.02}
  - {value: "max(high - low)", at-most: 1e-3}
  - {value: "max(abs(V/first(V) - 1))", at-most: 1e-12}
END2
"$BULLA" run contact.yaml >out 2>&1 || fail "thinc does not carry a bubble" out
"$BULLA" run contact.yaml -o minmod --set scheme.reconstruction=muscl >out 2>&1 && fail "minmod is as sharp" out
exit 0
