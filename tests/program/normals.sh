# One traction in the plane and in space: a bubble in a stretched gel, with levels and what moves across ranks. The same bits on 1,
# 2 and 3 ranks and after a restart; mass and energy to round-off; a surface along the mesh rests, which one pressure shakes.
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
"$BULLA" plan gel.yaml --set scheme.traction=auto >plain
! grep -q normal.c plain || fail 'normals that nobody asked for' plain
