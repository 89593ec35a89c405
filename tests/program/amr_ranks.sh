# Levels that move give the same bits on 1, 2, 3, 4 and 7 ranks: histories, probes and snapshots of runs in 2D with three
# materials, in 3D, axisymmetric with an interface that leaves the levels at an angle (refluxing is spread), with steps that the
# guard repairs, with cold gas that cannot bear what refluxing asks for (stopped and gone on with, too), without
# subcycling, and with a pulse that leaves, so that all finer levels go and come again.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

materials='materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  helium: {eos: {type: ideal-gas, gamma: 1.667}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}'
output='output:
  snapshots: {every: 100 steps, fields: [density, velocity, pressure, alpha_air, level], precision: double}
  history:
    columns: {V: {volume: air}, m: {mass: air}, pmax: {max: pressure}, E: {total: energy}, M: {total: mass}}'

cat >plane.yaml <<END2
bulla: 1
title: A blast and a bubble of two gases in a moving liquid
domain: {lower: [0, 0], upper: [1, 1], cells: [24, 24], boundaries: {x-: periodic, x+: periodic, y-: reflecting, y+: non-reflecting}}
mesh: {levels: 2, tile: 4, regrid-every: 2, buffer: 2, patience: 1, refine: [{jump: alpha_water, above: 0.1}, {jump: pressure, above: 0.5}]}
$materials
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: [200, 50]}
  - {sphere: {center: [0.3, 0.5], radius: 0.15}, material: water, density: 1100, pressure: 3e8}
  - {sphere: {center: [0.7, 0.6], radius: 0.12}, fractions: {air: 0.7, helium: 0.3}, density: {air: 1.2, helium: 0.17}, pressure: 1e5, velocity: [200, 50]}
run: {until: 1, max-steps: 24}
$output
  probes: {every: 1 steps, in: {at: [0.7, 0.5], fields: [pressure, velocity]}}
END2

cat >space.yaml <<END2
bulla: 1
title: A wave meets a bubble in 3D
domain:
  lower: [-1 mm, -1 mm, -1 mm]
  upper: [1 mm, 1 mm, 1 mm]
  cells: [12, 12, 12]
  boundaries:
    x-: {type: incoming-wave, pulse: sine, amplitude: 20 MPa, frequency: 1 MHz}
    x+: non-reflecting
    y-: periodic
    y+: periodic
    z-: reflecting
    z+: outflow
mesh: {levels: 2, tile: 4, regrid-every: 2, buffer: 2, patience: 1, refine: [{jump: alpha_air, above: 0.2}]}
$materials
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1 bar, velocity: [0, 200, 0]}
  - {sphere: {center: [0, 0.1 mm, -0.2 mm], radius: 0.4 mm}, material: air, density: 1.2, pressure: 1 bar, velocity: [0, 200, 0]}
run: {until: 1, max-steps: 10}
$output
  probes: {every: 1 steps, in: {at: [0.1 mm, 0, 0], fields: [pressure, velocity]}}
END2

cat >round.yaml <<END2
bulla: 1
title: A bubble crosses a patch along the axis
domain: {geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [16, 16], boundaries: {x-: axis, x+: reflecting, y-: periodic, y+: periodic}}
mesh: {levels: 2, tile: 4, regrid-every: 2, buffer: 2, patience: 1, refine: [{region: {box: {lower: [0, 0.55], upper: [0.25, 0.8]}}}, {jump: alpha_air, above: 0.3, finest: 1}]}
$materials
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1e6, velocity: ['= 300 * x * (1 - x)', 900]}
  - {sphere: {center: [0.2, 0.45], radius: 0.2}, fractions: {air: 0.7, helium: 0.3}, density: {air: 1.2, helium: 0.17}, pressure: 1e5, velocity: [0, 900]}
scheme: {limiter: superbee}
run: {until: 1, max-steps: 60}
$output
  probes: {every: 1 steps, in: {at: [0.1, 0.5], fields: [pressure, velocity]}}
END2

cat >parting.yaml <<END2
bulla: 1
title: Streams that part too fast for an explicit step
domain: {lower: [-1, -1], upper: [1, 1], cells: [16, 16], boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic}}
mesh: {levels: 2, tile: 4, regrid-every: 2, buffer: 3, patience: 1, subcycle: true, refine: [{jump: density, above: 0.1}]}
$materials
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1 bar, velocity: ['= x > 0 and 600 or -600', '= y > 0 and 600 or -600']}
  - {sphere: {center: [0.1, 0.1], radius: 0.3}, material: air, density: 1, pressure: 1 bar, velocity: [0, 0]}
scheme: {limiter: mc, cfl: 0.9}
run: {until: 1, max-steps: 10}
$output
  probes: {every: 1 steps, in: {at: [0.1, 0], fields: [pressure, velocity]}}
END2

cat >cold.yaml <<END2
bulla: 1
title: Two gases collide at Mach 50, and the shocks leave the fine level
domain: {lower: [0, 0], upper: [1, 0.25], cells: [64, 16], boundaries: {x-: outflow, x+: outflow, y-: periodic, y+: periodic}}
mesh: {levels: 2, tile: 4, refine: [{interface: air}]}
$materials
initial:
  - {everywhere: true, material: helium, density: 0.1694, pressure: 1 bar, velocity: [-20000, 500]}
  - {half-space: {normal: [-1, 0.2], point: [0.5, 0]}, material: air, density: 1.2, pressure: 1 bar, velocity: [15000, 0]}
run: {until: 1, max-steps: 60}
$output
  probes: {every: 1 steps, in: {at: [0.6, 0.1], fields: [pressure, velocity]}}
END2

cat >gone.yaml <<END2
bulla: 1
title: A pulse leaves, and its levels with it
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: outflow, x+: outflow, y-: periodic, y+: periodic}}
mesh: {levels: 2, tile: 8, regrid-every: 2, patience: 1, refine: [{jump: pressure, above: 0.02}]}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: 1}
  - {sphere: {center: [0.9, 0.5], radius: 0.06}, material: air, density: 1.1, pressure: 1.2}
run: {until: 0.6}
output: {history: {every: 1 steps, columns: {finest: {max: level}, m: {mass: air}}}}
END2
sed 's/patience: 1/patience: 1, subcycle: false/; s/max-steps: 24/max-steps: 20/' plane.yaml >whole.yaml

while read -r name all; do
    # shellcheck disable=SC2086
    ranked "$name" $all
    grep -q '"regrids": *[1-9]' "$name-1/refinement" || fail "$name: levels do not move"
done <<END2
plane 1 2 3 4 7
round 1 2 3 4 7
space 1 3 7
parting 1 2 4
cold 1 2 3
whole 1 3
gone 1 2 3
END2
# what two of them are about has happened
grep -q '"spread_refluxes": *[1-9]' round-1/refinement
grep -q '"spread_refluxes": *[1-9]' cold-1/refinement
resumed cold 40 cold-1
awk -F, 'NR > 1 && $4 != level { path = path $4; level = $4 } END { if (path !~ /^2.*0.*[12].*0$/) { print path; exit 1 } }' \
    gone-1/out/history.csv || fail "levels do not go and come again" gone-1/out/history.csv
grep -q '"relaxed": *[1-9]' parting-1/guard
grep -q '"fallback": *[1-9]' parting-1/guard
