# Maxwell branches of solids: a ball of gel with two branches and a drop of a Maxwell fluid in air hit a wall, in the plane, with
# levels. The same bits on 1, 2 and 3 ranks and after a restart; masses, energy to round-off; the plan shows the term; energy that
# relaxes is heat; where nothing is stretched, at rest, nothing is computed; a solid without branches has nothing of it.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >splash.yaml <<'END'
bulla: 1
title: Gel and slime hit a wall
domain: {lower: [0, 0], upper: [0.04, 0.02], cells: [64, 32], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8, levels: 1, regrid-every: 4, refine: [{value: overstress, above: 40 kPa}, {jump: density, above: 0.1}]}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  gel:
    eos: {type: stiffened-gas, gamma: 4.4, p-inf: 60 MPa}
    constitutive: {type: neo-hookean, shear-modulus: 1 MPa, reference-density: 1060}
    viscoelastic:
      - {shear-modulus: 3 MPa, relaxation-time: 5 us}
      - {shear-modulus: 2 MPa, relaxation-time: 0.1 ms}
  slime:
    eos: {type: stiffened-gas, gamma: 4.4, p-inf: 60 MPa}
    constitutive: {type: neo-hookean, shear-modulus: 0 Pa, reference-density: 1000}
    viscoelastic: [{shear-modulus: 2 MPa, relaxation-time: 20 us}]
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}
  - {sphere: {center: [0.01, 0.0071], radius: 0.006}, material: gel, density: 1060, pressure: 1e5, velocity: [5, -30]}
  - {sphere: {center: [0.0221, 0.0061], radius: 0.0052}, material: slime, density: 1000, pressure: 1e5, velocity: [-10, -30]}
run: {until: 1 ms, max-steps: 24}
output:
  directory: out
  checkpoints: {every: 12 steps}
  history:
    columns: {m: {mass: gel}, M: {mass: slime}, E: {total: energy}, s: {max: overstress}, q: {max: von_mises}, W: {max: strain_energy}}
expect:
  - {value: "abs(last(m)/first(m) - 1)", at-most: 1e-11}
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-11}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-12}
  - {value: "max(s)", at-least: 1e5}
  - {value: "max(q - s)", at-least: 1e4}
END
ranked splash 1 2 3
resumed splash 12 splash-1

# Tiles of air, gel or slime alone take narrowed paths; which ones do depends on their size, and numbers do not.
for tile in 8 16; do
    "$BULLA" run splash.yaml --set mesh.levels=0 --set mesh.tile=$tile --max-steps 10 -o tile-$tile --quiet || [ $? = 1 ]
    awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i } { print $at["s"], $at["q"], $at["W"] }' tile-$tile/history.csv >most-$tile
done
cmp most-8 most-16

"$BULLA" plan splash.yaml >plan
grep -q '^  branches .*gel tau = 5e-06 s, gel tau = 0.0001 s, slime tau = 2e-05 s .*core/scheme/viscoelastic.c' plan || fail "the plan does not say it" plan
! "$BULLA" plan "$BULLA_SOURCE/cases/verify/es1.yaml" | grep -q viscoelastic || fail "a branch that nobody named"

# A wave against its exact solution, where it crosses levels.
"$BULLA" run "$BULLA_SOURCE/cases/verify/pulse-s-levels.yaml" --variant quick -o levels --quiet >said || fail "the wave is wrong" said
