# What is wrong with the numbers of a solid that yields, relaxes or breaks is said with its line and a remedy before anything runs;
# what is merely doubtful is warned of.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >base.yaml <<'YAML'
bulla: 1
title: A metal beside a gas
domain: {lower: [0], upper: [1 mm], cells: [100], boundaries: {x-: outflow, x+: outflow}}
materials:
  gas: {eos: {type: ideal-gas, gamma: 1.4}}
  metal:
    eos: {type: stiffened-gas, gamma: 4.22, p-inf: 34.2 GPa}
    constitutive: {type: neo-hookean, shear-modulus: 47.7 GPa, reference-density: 8930}
    SOLID
initial:
  - {everywhere: true, material: metal, density: 8930, pressure: 1e5}
  - {half-space: {point: [0.5 mm], normal: [1]}, material: gas, density: 1.2, pressure: 1e5}
run: {until: 1 us}
YAML
try() { # LINES: a case in which the metal has these, too
    sed "s|SOLID|$1|" base.yaml >case.yaml
    code=0
    "$BULLA" check case.yaml >out 2>err || code=$?
}
bad() { # LINES MESSAGE REMEDY
    try "$1"
    [ "$code" = 2 ] || fail "exit code $code: $1" out err
    grep -q "^case.yaml:\(9\|10\):.*error: .*$2" err || fail "no '$2' with its line in:" err
    [ -z "$3" ] || grep -q "help: .*$3" err || fail "no remedy '$3' in:" err
}
doubtful() { # LINE MESSAGE
    try "$1"
    [ "$code" = 0 ] || fail "exit code $code: $1" out err
    grep -q "^case.yaml:9:.*warning: .*$2" err || fail "no warning '$2' in:" err
}

bad 'plastic: {type: von-mises, yield: 0 Pa}' 'plastic.yield: 0 Pa is outside' ''
bad 'plastic: {type: von-mises, yield: 48 GPa}' 'is not below its shear modulus' "leave 'plastic' out"
doubtful 'plastic: {type: von-mises, yield: 5 GPa}' 'is 0.1 of its shear modulus: strains are large'
try 'plastic: {type: von-mises, yield: 4.7 GPa}'
! grep -q 'strains are large' err || fail 'a strength of less than a tenth is warned of' err
bad 'plastic: {type: johnson-cook, preset: copper}' 'looks at temperatures, and nothing is said of the specific heat' "give 'cv' in its 'eos'"
bad 'plastic: {type: steinberg-guinan, preset: copper}' 'looks at temperatures, and nothing is said of the specific heat' "give 'cv'"
bad 'plastic: {type: von-mises, yield: 90 MPa, strain: always}\n    damage: {type: johnson-cook, preset: copper}' \
    'damage: .*looks at temperatures, and nothing is said of the specific heat' "give 'cv'"
bad 'viscoelastic: [{shear-modulus: 1 GPa, relaxation-time: 1 ps}]' 'relaxes within one time step' "'viscosity: 0.001 Pa s'"
doubtful 'viscoelastic: [{shear-modulus: 1 GPa, relaxation-time: 1 ns}]' 'the branch damps more than it should'
bad 'damage: {type: tension, stress: 1 GPa, opens: steam}' "opens: there is no material 'steam'" 'allowed: gas, metal'
bad 'damage: {type: tension, stress: 1 GPa, opens: metal}' "opens: 'metal' is a solid: a void is filled by a gas" ''
doubtful 'damage: {type: tension, stress: 1 GPa, time: 0.1 ns}' 'depends on the mesh'

try 'viscoelastic: [{shear-modulus: 1 GPa, relaxation-time: 1 us}]'
! grep -q 'first order' err || fail 'branches are warned of with midpoint' err
printf 'scheme: {integrator: ssprk3}\n' >>case.yaml
"$BULLA" check case.yaml >out 2>err || fail 'branches with ssprk3 are refused' err
grep -q "^case.yaml:[0-9]*:[0-9]*: warning: scheme.integrator: the branches .* to first order" err || fail 'no warning of ssprk3' err

# A wall drags a solid along, and what it needs for that is no viscosity.
sed -e '/SOLID/d' -e 's|cells: \[100\]|cells: [100], velocity-components: 2|' \
    -e 's|x-: outflow|x-: {type: no-slip, velocity: [0, 1]}|' base.yaml >wall.yaml
"$BULLA" check wall.yaml >out 2>err || fail 'a wall that shears a solid is refused' err
! grep -q 'drags nothing along' err || fail 'a wall that shears a solid is warned of' err

# A fluid neither yields nor relaxes nor breaks.
for key in 'plastic: {type: von-mises, yield: 1 MPa}' 'damage: {type: tension, stress: 1 MPa}' \
    'viscoelastic: [{shear-modulus: 1 MPa, relaxation-time: 1 us}]'; do
    sed -e 's/^    SOLID$//' -e "s/gamma: 1.4}}/gamma: 1.4}, $key}/" base.yaml >case.yaml
    code=0
    "$BULLA" check case.yaml >out 2>err || code=$?
    [ "$code" = 2 ] || fail "exit code $code: $key" out err
    grep -q "^case.yaml:5:.*error: .*'gas' is a fluid" err || fail 'a fluid with it passes' err
    grep -q 'help: .*constitutive: {type: neo-hookean' err || fail 'no remedy' err
done
