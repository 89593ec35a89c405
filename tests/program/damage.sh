# Solids that break, an operator after the step: a plate of gel is pulled apart in air until it tears and voids open, in the plane, with
# levels. The same bits on 1, 2 and 3 ranks, for other tiles' order of work, and after a restart; mass and energy to round-off; the
# plan shows the operator and its file; a law of plastic strain; what cannot be is refused, with its line and a remedy.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >tear.yaml <<'END'
bulla: 1
title: A plate of gel tears
domain: {lower: [0, 0], upper: [0.02, 0.02], cells: [32, 32], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8, levels: 1, regrid-every: 4, refine: [{jump: pressure, above: 2 MPa}, {value: damage, above: 0.1}]}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 718 J/kg/K}}
  vapour: {eos: {type: ideal-gas, gamma: 1.33, cv: 1400 J/kg/K}}
  gel:
    eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}
    constitutive: {type: neo-hookean, shear-modulus: 20 MPa, reference-density: 1060}
    damage: {type: tension, stress: 5 MPa, opens: vapour}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}
  - {box: {lower: [0.004, 0.0062], upper: [0.0162, 0.0131]}, material: gel, density: 1060, pressure: 1e5, velocity: ["= 2000*(x - 0.01)", 0]}
scheme: {cfl: 0.4}
run: {until: 1 ms, max-steps: 40}
output:
  directory: out
  checkpoints: {every: 20 steps}
  history:
    columns: {m: {mass: gel}, g: {mass: vapour}, M: {total: mass}, E: {total: energy}, D: {max: damage}, V: {volume: vapour}, broken: {integral: damage}}
expect:
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-12}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-12}
  - {value: "last(m) + last(g) - first(m)", equals: 0, tolerance: 1e-12}
  - {value: "last(D)", equals: 1, tolerance: 1e-12}
  - {value: "last(V)", at-least: 1e-8}
  - {value: "last(g)/last(m)", at-most: 1e-6}
  - {value: "last(broken)", at-least: 1e-6}
END
ranked tear 1 2 3
resumed tear 20 tear-1

"$BULLA" plan tear.yaml >plan
grep -q '^  rupture .*gel tension opens vapour.*core/scheme/rupture.c' plan || fail "no operator" plan
"$BULLA" check tear.yaml >said
grep -q 'breaks in .* at the fastest; where it is in tension a void of vapour opens, at 1 kPa' said || fail "not said" said

# Damage by plastic strain: as far as the strain goes, whatever the number of ranks; the strain alone is the same without damage as
# long as nothing breaks.
sed -e 's/tear/flows/; s/damage: {.*/plastic: {type: von-mises, yield: 20 kPa, strain: always}\n    damage: {type: johnson-cook, d1: 0.05, d2: 0, d3: 0}/' \
    -e '/last(V)/d; /last(g)/d; /last(D)/d; /last(broken)/d; s/, V: {volume: vapour}//; s/g: {mass: vapour}, //; s/, broken: .integral: damage./, eps: {max: plastic_strain, in: gel}/; s/D: {max: damage}/D: {max: damage, in: gel}/' \
    -e '/^  vapour:/d' tear.yaml >flows.yaml
echo '  - {value: "last(D)/last(eps)", equals: 20, tolerance: 1}' >>flows.yaml
ranked flows 1 2

# --- refused ---
wrong() { # PATTERN SETTING...
    pattern=$1
    shift
    code=0
    "$BULLA" check tear.yaml "$@" >out 2>err || code=$?
    [ $code = 2 ] || fail "exit code $code: $*" err
    grep -q -- "$pattern" err || fail "no '$pattern' in:" err
    grep -q "tear.yaml:[0-9]*:[0-9]*: error\|error" err || fail "no line:" err
}
one() { wrong "$1" --set "materials.gel.damage.$2"; }
one "there is no material 'vapor'" opens=vapor
one "did you mean 'vapour'" opens=vapor
one "'gel' is a solid: a void is filled by a gas" opens=gel
one 'is outside 0.001 to' 'stress=-5 MPa'
wrong "looks at plastic strain, and 'gel' has no 'plastic' law" --set 'materials.gel.damage={type: strain, begins: 0.1}'
sed 's/damage: {.*/plastic: {type: von-mises, yield: 1 MPa}\n    damage: {type: strain, begins: 0.1}/' tear.yaml >bare.yaml
refused_by() { # FILE PATTERN
    code=0
    "$BULLA" check "$1" >out 2>err || code=$?
    [ $code = 2 ] && grep -q -- "$2" err && grep -q "$1:[0-9]*:[0-9]*: error" err || fail "$1: exit code $code, no '$2':" err
}
refused_by bare.yaml "which the strength of 'gel' does not keep"
sed 's/  air: {eos/  air: {damage: {type: tension, stress: 1 MPa}, eos/' tear.yaml >fluid.yaml
refused_by fluid.yaml "'air' is a fluid: what breaks has an elastic law"
sed 's/  vapour: .*/  vapour: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa, cv: 1000 J\/kg\/K}}/' tear.yaml >liquid.yaml
refused_by liquid.yaml "'vapour' is no gas"
sed 's/, opens: vapour/, void-pressure: 1 kPa/; /^  vapour:/d; /last(V)/d; /last(g)/d; s/, V: {volume: vapour}//; s/g: {mass: vapour}, //' tear.yaml >closed.yaml
refused_by closed.yaml "there is no void: nothing 'opens'"
sed 's/damage: {.*/plastic: {type: von-mises, yield: 1 MPa}\n    damage: {type: johnson-cook, preset: copper}/' tear.yaml >warm.yaml
refused_by warm.yaml "nothing is said of the specific heat of 'gel'"
sed 's/type: tension, stress: 5 MPa/type: stretch, begins: 1.9, ends: 1.5/' tear.yaml >ramp.yaml
refused_by ramp.yaml "'ends' is below 'begins'"
sed '/damage: {type/d; s/, {value: damage, above: 0.1}//; s/, D: {max: damage}//; s/, broken: .*}}/}/; /(broken)/d; /(D)/d' tear.yaml >whole.yaml
sed 's/{value: "last(V)"/{value: "last(x)"/' whole.yaml | sed 's/, V: {volume: vapour}/, V: {volume: vapour}, x: {max: damage}/' >none.yaml
refused_by none.yaml "'damage' is a field of solids that can break"
"$BULLA" check tear.yaml --set 'materials.gel.damage.time=1 ns' >out 2>err
grep -q 'warning: materials.gel.damage.time: a wave crosses' err || fail "no warning" err

# Voids where solid and fluid share the traction: the gas needs a pressure above 0 beside stone in tension.
"$BULLA" run "$BULLA_SOURCE/cases/tour/stone.yaml" --variant quick --set scheme.traction=common -o stone --quiet >said || fail "voids with a common traction" said
