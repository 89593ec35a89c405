# Two solids, each on its own stretch: a plastic plate with a gel that has a branch and can break welded to its oblique face, in
# air, sheared, in the plane, with levels. The same bits on 1, 2 and 3 ranks, after a restart and in tiles of another size;
# masses and energy to round-off; the plan shows the term, fields have the names of their solids. One solid alone, or two
# without velocities along their contact, have nothing of it.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >plate.yaml <<'END2'
bulla: 1
title: A gel on a plate
domain: {lower: [0, 0], upper: [0.04, 0.02], cells: [64, 32], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8, levels: 1, regrid-every: 4, refine: [{jump: density, above: 0.05}, {value: von_mises, above: 30 MPa}]}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  gel:
    eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}
    constitutive: {type: fung, shear-modulus: 5 MPa, stiffening: 0.5, reference-density: 1060}
    viscoelastic: [{shear-modulus: 3 MPa, relaxation-time: 5 us}]
    damage: {type: stretch, begins: 1.05, ends: 1.3}
  plate:
    eos: {type: stiffened-gas, gamma: 4, p-inf: 2 GPa}
    constitutive: {type: neo-hookean, shear-modulus: 1 GPa, reference-density: 2700}
    plastic: {type: von-mises, yield: 20 MPa, hardening: 100 MPa}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}
  - {polygon: {vertices: [[0.0021, 0.0023], [0.0312, 0.0057], [0.0298, 0.0142], [0.0032, 0.0091]]}, material: plate, density: 2700, pressure: 1e5, velocity: [40, 20]}
  - {polygon: {vertices: [[0.0298, 0.0142], [0.0032, 0.0091], [0.0041, 0.0163], [0.0251, 0.0181]]}, material: gel, density: 1060, pressure: 1e5, velocity: [-10, 15]}
run: {until: 1 ms, max-steps: 24}
output:
  directory: out
  checkpoints: {every: 12 steps}
  history:
    columns: {m: {mass: gel}, M: {mass: plate}, E: {total: energy}, q: {max: von_mises}, D: {max: damage}, e: {max: plastic_strain}, W: {max: strain_energy}, V: {max: stretch_max}}
expect:
  - {value: "abs(last(m)/first(m) - 1)", at-most: 1e-11}
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-11}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-12}
  - {value: "last(D)", at-least: 0.01}
  - {value: "last(e)", at-least: 1e-4}
END2
ranked plate 1 2 3
resumed plate 12 plate-1

for tile in 8 16; do
    "$BULLA" run plate.yaml --set mesh.levels=0 --set mesh.tile=$tile --max-steps 10 -o tile-$tile --quiet || [ $? = 1 ]
    awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i } { print $at["q"], $at["D"], $at["W"], $at["V"] }' tile-$tile/history.csv >most-$tile
done
cmp most-8 most-16

"$BULLA" plan plate.yaml >plan
grep -q '^  weld .*core/scheme/weld.c' plan || fail 'the plan has no weld' plan
grep -q '^  cling .*core/scheme/cling.c' plan || fail 'the plan has no cling' plan
"$BULLA" check plate.yaml >check
grep -q 'stretch_gel_xx' check && grep -q 'stretch_plate_xy' check || fail 'the check does not name the stretches' check
! "$BULLA" plan "$BULLA_SOURCE/cases/verify/es1.yaml" | grep -q 'weld.c\|cling.c' || fail 'a weld of one solid'
! "$BULLA" plan "$BULLA_SOURCE/cases/verify/h22-al-cu.yaml" | grep -q 'weld.c\|cling.c' || fail 'a weld without shear'

# Closed forms: the shear traction of welded halves that are carried, and stripes that keep theirs.
for case in weld-10 weld-100 weld-dense weld-light weld-carried; do
    "$BULLA" run "$BULLA_SOURCE/cases/verify/$case.yaml" --variant quick -o "$case" --quiet >said || fail "$case is wrong" said
done

# All that and 1000 m/s along the contact: what the solids draw upon each other does work at that speed, or pressures go.
sed -e 's/\[500, -1\]/[500, 999]/; s/\[500, 1\]/[500, 1001]/; s/0\.519493853/1000.519493853/' \
    -e 's/^      most: .*/&\n      p: {max: pressure}/; s/^    - {value: "last(v)"/    - {value: "max(p)", at-most: 1.02e5}\n&/' \
    "$BULLA_SOURCE/cases/verify/weld-10.yaml" >moved.yaml
"$BULLA" run moved.yaml --variant quick -o moved --quiet >said || fail 'a contact that moves along itself is wrong' said

# In space: the same bits on both ways round, and the stripes keep their traction where shear has two directions.
cat >block.yaml <<'END2'
bulla: 1
title: Stripes in space
domain: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [16, 16, 16], boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic, z-: periodic, z+: periodic}}
mesh: {tile: 8}
materials:
  soft: {eos: {type: stiffened-gas, gamma: 4, p-inf: 1 GPa}, constitutive: {type: neo-hookean, shear-modulus: 100 MPa, reference-density: 1000}}
  stiff: {eos: {type: stiffened-gas, gamma: 4, p-inf: 1 GPa}, constitutive: {type: neo-hookean, shear-modulus: 1 GPa, reference-density: 1000}}
initial:
  - {everywhere: true, material: soft, density: 1000, pressure: 1e5, velocity: [300, 0, 0], stretch: {xz: 0.005, xy: 0.0025}}
  - {box: {lower: [0.26, -1, -1], upper: [0.77, 2, 2]}, material: stiff, density: 1000, pressure: 1e5, velocity: [300, 0, 0], stretch: {xz: 0.0005, xy: 0.00025}}
run: {until: 0.4 ms}
output: {directory: out, history: {every: 1 step, columns: {most: {max: stress_xz}, least: {min: stress_xz}, other: {max: stress_xy}}}}
expect:
  - {value: "last(most)/1e6 - 1", at-most: 0.002}
  - {value: "1 - last(least)/1e6", at-most: 0.002}
  - {value: "abs(last(other)/5e5 - 1)", at-most: 0.002}
END2
"$BULLA" run block.yaml -o block --quiet >said || fail 'stripes in space are wrong' said
