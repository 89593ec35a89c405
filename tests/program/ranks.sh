# The bits of a 3D run, and of runs whose steps the guard redoes, halves and relaxes, are the same on 1, 2, 3 and 4 ranks.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >space.yaml <<'END'
bulla: 1
title: A wave meets a bubble in 3D
domain:
  lower: [-1 mm, -1 mm, -1 mm]
  upper: [1 mm, 1 mm, 1 mm]
  cells: [24, 24, 24]
  boundaries:
    x-: {type: incoming-wave, pulse: sine, amplitude: 20 MPa, frequency: 1 MHz}
    x+: non-reflecting
    y-: periodic
    y+: periodic
    z-: reflecting
    z+: outflow
mesh: {tile: 8}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1 bar, velocity: [0, 10, 0]}
  - {sphere: {center: [0, 0.1 mm, -0.2 mm], radius: 0.6 mm}, material: air, density: 1.2, pressure: 1 bar}
run: {until: 1 us, max-steps: 12}
output:
  snapshots: {every: 12 steps, fields: [density, velocity, pressure, alpha_air, schlieren, vorticity], precision: double}
  history:
    columns: {V: {volume: air}, m: {mass: air}, z: {centroid: air, along: z}, pmax: {max: pressure}, E: {total: energy}}
  probes: {every: 1 steps, in: {at: [0.1 mm, 0, 0], fields: [pressure, velocity]}}
END

{ parting 'closure: allaire' 18; cat <<'END'; } >parting.yaml
output:
  snapshots: {every: 18 steps, fields: [density, velocity, pressure, alpha_air], precision: double}
  history: {columns: {m: {mass: air}, E: {total: energy}, pmin: {min: pressure}}}
  probes: {every: 1 steps, in: {at: [0.1, 0], fields: [pressure, velocity]}}
END

sed 's/closure: allaire/closure: kapila/' parting.yaml >relaxing.yaml

for name in space parting relaxing; do ranked $name 1 2 3 4; done
# the last two are about repairs: all kinds of them must have happened
grep -q '"fallback": *[1-9]' parting-1/guard
grep -q '"retries": *[1-9]' parting-1/guard
grep -q '"relaxed": *[1-9]' relaxing-1/guard
