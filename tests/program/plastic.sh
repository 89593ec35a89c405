# Plastic flow of a solid, an operator after the step: a bar of metal that hardens hits a wall in air, in the plane, with levels.
# The same bits on 1, 2 and 3 ranks, for other tiles' order of work, and after a restart; mass and energy to round-off; the plan shows the operator and its file; a
# solid without a strength has nothing of it.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >bar.yaml <<'END'
bulla: 1
title: A bar of aluminium hits a wall
domain: {lower: [0, 0], upper: [0.02, 0.02], cells: [32, 32], boundaries: {x-: symmetry, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8, levels: 1, regrid-every: 4, refine: [{jump: pressure, above: 300 MPa}, {value: plastic_strain, above: 0.02}]}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  aluminium:
    eos: {type: stiffened-gas, gamma: 3.5, p-inf: 22 GPa}
    constitutive: {type: neo-hookean, shear-modulus: 27.6 GPa, reference-density: 2785}
    plastic: {type: von-mises, yield: 300 MPa, hardening: 500 MPa, exponent: 0.5}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}
  - {box: {lower: [0, 0], upper: [0.0062, 0.0131]}, material: aluminium, density: 2785, pressure: 1e5, velocity: [0, -200]}
run: {until: 1 ms, max-steps: 40}
output:
  directory: out
  checkpoints: {every: 20 steps}
  history:
    columns: {m: {mass: aluminium}, M: {mass: air}, E: {total: energy}, eps: {max: plastic_strain}, q: {max: von_mises}, Y: {max: flow_stress}}
expect:
  - {value: "abs(last(m)/first(m) - 1)", at-most: 1e-12}
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-10}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-12}
  - {value: "last(eps)", at-least: 0.03}
  - {value: "min(eps)", at-least: 0}
  - {value: "max(q)", at-least: 4e8}
END
ranked bar 1 2 3
resumed bar 20 bar-1

"$BULLA" plan bar.yaml >plan
grep -q '^after the last stage, before close:$' plan || { cat plan; exit 1; }
grep -q '^  plastic .*aluminium von-mises .*core/scheme/plastic.c' plan || { cat plan; exit 1; }
grep -q '^  hardening .*core/scheme/hardening.c' plan || { cat plan; exit 1; }

# A perfectly plastic solid has no field of strain unless that is asked for; then its motion has the same bits.
perfect="--set materials.aluminium.plastic.hardening=0 --set mesh.levels=0 --max-steps 10"
"$BULLA" run bar.yaml $perfect --set materials.aluminium.plastic.strain=always -o told --quiet || [ $? = 1 ]
sed -e 's/, {value: plastic_strain, above: 0.02}//' -e 's/eps: {max: plastic_strain}, //' -e '/value: .*(eps)/d' bar.yaml >bare.yaml
"$BULLA" run bare.yaml $perfect -o bare --quiet || [ $? = 1 ]
drop() { awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "eps") c = i } { for (i = 1; i <= NF; i++) if (i != c) printf "%s,", $i; print "" }' "$1"; }
drop told/history.csv >a
drop bare/history.csv >b
cmp a b
! "$BULLA" plan bare.yaml $perfect | grep -q hardening
