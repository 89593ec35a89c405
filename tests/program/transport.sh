# A small bubble with viscosity, heat, tension and faces for slow flow together, with a level: the same bits on 1 and 3 ranks and
# after a restart; its gas stays to round-off.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >ring.yaml <<'END'
bulla: 1
title: A bubble that rings down
domain: {geometry: spherical, lower: [0], upper: [100 um], cells: [200], boundaries: {x-: symmetry, x+: {type: non-reflecting, pressure: 1 atm}}}
mesh: {levels: 1, refine: [{interface: air}]}
materials:
  water: {eos: {type: nasg, preset: water}, viscosity: 0.89 mPa s, conductivity: 0.607 W/m/K}
  air: {eos: {type: ideal-gas, preset: air}, viscosity: {type: sutherland, preset: air}, conductivity: {type: sutherland, preset: air}}
surface-tension: {water+air: 72.8 mN/m}
initial:
  - {everywhere: true, material: water, pressure: 1 atm, temperature: 300 K}
  - {sphere: {center: [0], radius: 5 um}, material: air, pressure: 1.5 atm, temperature: 300 K}
scheme: {low-mach: 0.05}
run: {until: 0.05 us}
output:
  directory: out
  snapshots: {every: 0.05 us, fields: [pressure, velocity, temperature_air], precision: double}
  checkpoints: {every: 100 steps}
  history: {every: 1 step, columns: {R: {equivalent-radius: air}, m: {mass: air}, E: {total: energy}}}
expect: [{value: "max(abs(m/first(m) - 1))", at-most: 1e-12}]
END
ranked ring 1 3
resumed ring 150 ring-1
