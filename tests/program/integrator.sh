# The third integrator, ssprk3, everywhere: the same bits on 1, 2 and 3 ranks, with levels, a solid, curved geometry and
# repaired cells; restarted runs go on as if nothing had been; mass and energy are conserved to round-off; resting tiles
# are skipped without a trace.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >jet.yaml <<'END'
bulla: 1
title: A wave meets a bubble before a gel
domain:
  geometry: axisymmetric
  lower: [0, -1 mm]
  upper: [1 mm, 1 mm]
  cells: [16, 32]
  boundaries:
    x-: axis
    x+: reflecting
    y-: reflecting
    y+: reflecting
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, constitutive: {type: neo-hookean, shear-modulus: 40 MPa, reference-density: 1050}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1 bar}
  - {half-space: {point: [0, 0.6 mm], normal: [0, 1]}, material: water, density: 1010, pressure: 300 bar}
  - {half-space: {point: [0, -0.6 mm], normal: [0, -1]}, material: gel, density: 1050, pressure: 1 bar}
  - {sphere: {center: [0, 0], radius: 0.4 mm}, material: air, density: 1.2, pressure: 1 bar}
mesh: {tile: 8, levels: 1, refine: [{interface: air}, {jump: pressure, above: 1 MPa}]}
scheme: {integrator: ssprk3, riemann: hlld, cfl: 0.5}
run: {until: 1 us, max-steps: 24}
output:
  directory: out
  snapshots: {every: 24 steps, fields: [density, velocity, pressure, alpha_air, stress_xx], precision: double}
  checkpoints: {every: 10 steps, keep: 3}
  history: {every: 1 step, columns: {V: {volume: air}, m: {mass: air}, M: {mass: water}, E: {total: energy}, p: {max: pressure}}}
expect:
  - {value: "abs(last(m)/first(m) - 1)", at-most: 1e-12}
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-12}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-12}
END

ranked jet 1 2 3

# Stopped after 10 of 24 steps, on two ranks, and gone on with on one.
resumed jet 10 jet-1
"$BULLA_BUILD/tests/test-unit-snapshot" jet-1/out/fields/jet_000024.hdf jet-resumed/out/fields/jet_000024.hdf

# Nothing moves where nothing happens, and nearly all of it is skipped.
resting ssprk3 5 >rest.yaml
"$BULLA" run rest.yaml -o rest --quiet
grep -q '"cells_carried": *15360' rest/provenance.json || fail "not all of 5 steps of 3 stages of 1024 cells were carried on"

# Streams that part: cells are marked, steps repeated; the same on any number of ranks.
{ parting 'closure: kapila, integrator: ssprk3' 12; cat <<'END'; } >parting.yaml
output:
  history: {columns: {m: {mass: air}, E: {total: energy}, pmin: {min: pressure}}}
END
sed 's/closure: kapila/closure: allaire/' parting.yaml >torn.yaml
for name in parting torn; do ranked $name 1 2 3; done
grep -q '"relaxed": *[1-9]' parting-1/guard || fail "nothing was repaired"
grep -q '"fallback": *[1-9]' torn-1/guard || fail "no cell was marked"
