# Scenes that nobody would write: those that tests/scenes/draw.py draws from a seed, of which each has once shown a fault, and
# three that end by themselves, or never, where a law is forgotten. BULLA_SCENES: other seeds, as in `1..400`.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
seeds=${BULLA_SCENES:--q 8 63 74 94 101 105 114 179 184 276 286}

# shellcheck disable=SC2086
PYTHONDONTWRITEBYTECODE=1 "${python3:-python3}" "$BULLA_SOURCE/tests/scenes/hunt.py" $seeds || fail "see above"
[ -z "${BULLA_SCENES:-}" ] || exit 0

# Two drops meet in air, and between them water is torn: the air in it is so thin that its heat would ask for steps of 1e-16 s.
cat >torn.yaml <<'END_TORN'
bulla: 1
title: Drops that meet
domain:
  geometry: axisymmetric
  lower: [0, 0]
  upper: [5.5 mm, 5.5 mm]
  cells: [32, 32]
  boundaries: {x-: axis, x+: reflecting, y-: symmetry, y+: reflecting}
mesh: {tile: 8, levels: 2, refine: [{interface: air}, {jump: pressure, above: 0.1}], regrid-every: 3}
materials:
  water: {eos: {type: mnasg, preset: water}, viscosity: 26.3 mPa s, conductivity: 0.6 W/m/K}
  air: {eos: {type: ideal-gas, gamma: 1.67, cv: 3115}, viscosity: 18 uPa s, conductivity: 0.026 W/m/K}
surface-tension: {water+air: 72.8 mN/m}
initial:
  - {everywhere: true, material: air, temperature: 300, pressure: 101403, velocity: [0, -72.9]}
  - {sphere: {center: [1.48 mm, 1.51 mm], radius: 1.25 mm}, material: water, temperature: 300, pressure: 101403, velocity: [0, -70.7]}
  - {sphere: {center: [0, 3.45 mm], radius: 1.49 mm}, material: water, temperature: 300, pressure: 304209, velocity: [0, 19.1]}
run: {until: 1 s, max-steps: 16}
output: {history: {every: 1 steps, columns: {m: {mass: water}, E: {total: energy}}}}
expect:
  - {value: "min(between(dt, 1e-20, 1))*1e9", label: "least step, ns", at-least: 5}
  - {value: "max(abs(m/first(m) - 1))", label: "drift of the water", at-most: 1e-12}
END_TORN
limited "$BULLA" run torn.yaml --quiet --overwrite 2>err || fail "torn water" err

# Thick water boils into dry air. Half a cell of water, half of steam beside air: with materials told apart by their number
# that is no surface, and air gets the stress of water.
cat >boiling.yaml <<'END_BOILING'
bulla: 1
title: Thick water boils
domain:
  geometry: axisymmetric
  lower: [0, 0]
  upper: [18.6 um, 18.6 um]
  cells: [32, 32]
  boundaries: {x-: axis, x+: reflecting, y-: periodic, y+: periodic}
mesh: {tile: 8, levels: 1, refine: [{interface: steam}], regrid-every: 3}
materials:
  water: {eos: {type: nasg, preset: water-2016}, viscosity: 0.444 Pa s}
  air: {eos: {type: ideal-gas, gamma: 1.67, cv: 3115}, viscosity: 18 uPa s}
  steam: {eos: {type: ideal-gas, preset: water-2016}}
phase-change: [{liquid: water, vapour: steam, gases: [air]}]
initial:
  - {everywhere: true, material: air, temperature: 380, pressure: 101530}
  - {half-space: {point: [0, 10.1 um], normal: [-0.0855, -0.449]}, material: water, temperature: 380, pressure: 101530}
  - {half-space: {point: [0, 12 um], normal: [-0.766, -0.999]}, material: steam, temperature: 380, pressure: 101530}
run: {until: 1 s, max-steps: 16}
output: {history: {every: 1 steps, columns: {u: {max: "= math.sqrt(velocity_x^2 + velocity_y^2)"}}}}
expect:
  - {value: "max(u)", label: "fastest, m/s", at-most: 300} # 136; 1e3 in the second step
END_BOILING
limited "$BULLA" run boiling.yaml --quiet 2>err || fail "thick water that boils" err

# Supersaturated steam in air condenses at once, in cells that held no water when the step began, and what of it flows on in
# the second stage is owed by the steam.
cat >owed.yaml <<'END_OWED'
bulla: 1
title: Steam condenses in air
domain:
  lower: [0, 0]
  upper: [0.7 mm, 0.7 mm]
  cells: [24, 24]
  boundaries: {x-: symmetry, x+: reflecting, y-: periodic, y+: periodic}
mesh: {tile: 8}
materials:
  water: {eos: {type: nasg, preset: water-2016}}
  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}}
  steam: {eos: {type: ideal-gas, preset: water-2016}}
phase-change: [{liquid: water, vapour: steam, gases: [air]}]
initial:
  - {everywhere: true, material: air, temperature: 380, pressure: 2.73 MPa}
  - {box: {lower: [0.35 mm, 0.14 mm], upper: [0.53 mm, 0.54 mm]}, material: steam, temperature: 380, pressure: 27.3 MPa}
  - {sphere: {center: [0.27 mm, 0.46 mm], radius: 0.24 mm}, material: water, temperature: 380, pressure: 2.73 MPa}
run: {until: 1 s, max-steps: 16}
output: {history: {every: 1 steps, columns: {w: {mass: water}, s: {mass: steam}, E: {total: energy}}}}
expect:
  - {value: "max(abs((w + s)/(first(w) + first(s)) - 1))", label: "drift of water and steam", at-most: 1e-12}
  - {value: "max(abs(E/first(E) - 1))", label: "drift of the energy", at-most: 1e-12}
  - {value: "min(between(dt, 1e-20, 1))*1e9", label: "least step, ns: that of sound", at-least: 3} # 0.8
END_OWED
limited "$BULLA" run owed.yaml --quiet 2>err || fail "steam that condenses in air" err
