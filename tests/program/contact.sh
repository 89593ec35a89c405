# Angles at walls: the same bits on ranks, through levels and after a restart; a right angle is none; walls above and below
# alike; what makes no sense is refused at its place.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

# A drop on a wall, off centre, a level around its surface, beside a second wall with another angle.
cat >cap.yaml <<'END'
bulla: 1
title: a drop on a wall
domain:
  lower: [0, 0]
  upper: [16 um, 16 um]
  cells: [32, 32]
  boundaries: {x-: {type: no-slip, contact-angle: {gas+liquid: 60 deg}}, x+: reflecting, y-: {type: no-slip, contact-angle: {liquid+gas: 60 deg}}, y+: outflow}
mesh: {tile: 8, levels: 1, refine: [{interface: gas}]}
materials:
  liquid: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 0.5 MPa}, viscosity: 6 mPa s}
  gas: {eos: {type: ideal-gas, gamma: 1.4}, viscosity: 1 mPa s}
surface-tension: {liquid+gas: 72.8 mN/m}
initial:
  - {everywhere: true, material: gas, density: 50, pressure: 1 atm}
  - {sphere: {center: [2.5 um, 0], radius: 4.2 um}, material: liquid, density: 1000, pressure: 1 atm, balance: tension}
run: {until: 0.2 us}
output:
  snapshots: {every: 0.2 us, fields: [density, velocity, pressure, alpha_gas], precision: double}
  history: {every: 5 steps, columns: {m: {mass: liquid}, W: {integral: alpha_liquid, where: {box: {lower: [0, 0], upper: [16 um, 0.5 um]}}}}}
  checkpoints: {every: 20 steps}
expect: [{value: "max(abs(m/first(m) - 1))", at-most: 1e-13}, {value: last(W)/first(W), at-least: 1.003}]
END
ranked cap 1 3
resumed cap 30 cap-1

# A right angle is what walls have without one, bit by bit.
sed 's/, contact-angle: {[^}]*}//g' cap.yaml >none.yaml
sed 's/60 deg/90 deg/g' cap.yaml >right.yaml
sed -i '/^expect/d' none.yaml right.yaml
ran none none
ran right right
cmp none/out/history.csv right/out/history.csv
if cmp -s none/out/history.csv cap-1/out/history.csv; then fail "angles do nothing"; fi

# In space, and around an axis, where the wall ends.
cat >space.yaml <<'END'
bulla: 1
extends: ../cap.yaml
domain:
  lower: [0, 0, 0]
  upper: [12 um, 12 um, 12 um]
  cells: [12, 12, 12]
  boundaries: {x-: symmetry, x+: reflecting, y-: symmetry, y+: reflecting, z-: reflecting, z+: {type: no-slip, contact-angle: {liquid+gas: 120 deg}}}
mesh: {tile: 4, levels: 0, refine: []}
initial: [{everywhere: true, material: gas, density: 50, pressure: 1 atm}, {sphere: {center: [0, 0, 12 um], radius: 8 um}, material: liquid, density: 1000, pressure: 1 atm, balance: tension}]
run: {until: 0.4 us}
output:
  history: {every: 5 steps, columns: {m: {mass: liquid}, W: {integral: alpha_liquid, where: {box: {lower: [0, 0, 11 um], upper: [12 um, 12 um, 12 um]}}}}}
expect: [{value: "max(abs(m/first(m) - 1))", at-most: 1e-13}, {value: last(W)/first(W), at-most: 0.99}]
END
cat >axis.yaml <<'END'
bulla: 1
extends: ../cap.yaml
domain:
  geometry: axisymmetric
  boundaries: {x-: axis, x+: {type: no-slip, contact-angle: {liquid+gas: 60 deg}}, y-: reflecting, y+: {type: no-slip, contact-angle: {liquid+gas: 60 deg}}}
initial: [{everywhere: true, material: gas, density: 50, pressure: 1 atm}, {sphere: {center: [0, 16 um], radius: 4.2 um}, material: liquid, density: 1000, pressure: 1 atm, balance: tension}]
output:
  history: {every: 5 steps, columns: {m: {mass: liquid}, W: {integral: alpha_liquid, where: {box: {lower: [0, 15.5 um], upper: [16 um, 16 um]}}}}}
expect: [{value: "max(abs(m/first(m) - 1))", at-most: 1e-13}, {value: last(W)/first(W), at-least: 1.01}]
END
ranked space 1 2
ranked axis 1 2

refused() { # WHAT BOUNDARY [SETTING...]: ends with 2 and says so
    what=$1 boundary=$2
    shift 2
    code=0
    "$BULLA" show cap.yaml --set "domain.boundaries.y-=$boundary" "$@" >said 2>&1 || code=$?
    [ "$code" -eq 2 ] || fail "$boundary: code $code" said
    grep -qF "$what" said || fail "$boundary: does not say '$what'" said
}
for type in reflecting symmetry outflow; do
    refused "'contact-angle' is a key of 'type: no-slip'" "{type: $type, contact-angle: {liquid+gas: 60 deg}}"
done
refused "did you mean '60 deg'?" '{type: no-slip, contact-angle: {liquid+gas: 60}}'
refused '190 deg is no angle of contact' '{type: no-slip, contact-angle: {liquid+gas: 190 deg}}'
refused 'contact-angle.liquid+gas' '{type: no-slip, contact-angle: {liquid+gas: 0 deg}}'
refused 'is a length' '{type: no-slip, contact-angle: {liquid+gas: 60 mm}}'
refused "did you mean 'gas'?" '{type: no-slip, contact-angle: {liquid+gass: 60 deg}}'
refused "'liquid' is no pair" '{type: no-slip, contact-angle: {liquid: 60 deg}}'
refused 'an angle here already' '{type: no-slip, contact-angle: {liquid+gas: 60 deg, gas+liquid: 120 deg}}'
refused 'no surface tension, so nothing makes it keep an angle' '{type: no-slip, contact-angle: {liquid+gas: 60 deg}}' --set surface-tension=null
"$BULLA" show cap.yaml --set 'domain.boundaries.y-={type: no-slip, contact-angle: {liquid+gas: 5 deg}}' >said 2>&1 || fail "5 deg" said
grep -q 'a wedge of 5 deg is thinner than a cell for 11 cells' said || fail "no warning of a thin wedge" said
