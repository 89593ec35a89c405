# A boundary from outside the tree, a wall that gives way (tests/plugin/impedance.c): what it reflects of a pulse is what
# (Z_w - Z)/(Z_w + Z) says, at either end of an axis, along x and along y; the same bits on 1, 2 and 3 ranks and after a restart, with
# levels that touch it; rest stays rest, and tiles at rest beside a wall that says so are skipped; its keys are checked, told and
# documented like those of a built-in type.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cmake -G Ninja -S "$BULLA_SOURCE/tests/plugin" -B plugin -Dbulla_DIR="$BULLA_SOURCE/core/include/bulla" >log 2>&1 &&
    cmake --build plugin >>log 2>&1 || fail "the plugins do not build" log
"$BULLA" module check plugin/boundary-impedance.so >out 2>&1 || fail "impedance does not hold" out

# A pulse of 1 kPa runs in water (Z = 1.643e6) to the wall and back. The probe sees it pass twice; the ratio of what passes is R.
tube() { # NAME WALL AXIS SIDE
    case $3$4 in
    x+) box='lower: [0, 0], upper: [1, 0.02], cells: [400, 8]' in=x- other='y-: reflecting, y+: reflecting' at='[0.5, 0]' ;;
    x-) box='lower: [-1, 0], upper: [0, 0.02], cells: [400, 8]' in=x+ other='y-: reflecting, y+: reflecting' at='[-0.5, 0]' ;;
    y+) box='lower: [0, 0], upper: [0.02, 1], cells: [8, 400]' in=y- other='x-: reflecting, x+: reflecting' at='[0, 0.5]' ;;
    y-) box='lower: [0, -1], upper: [0.02, 0], cells: [8, 400]' in=y+ other='x-: reflecting, x+: reflecting' at='[0, -0.5]' ;;
    esac
    cat >"$1.yaml" <<END
bulla: 1
title: A pulse meets a wall that gives way
modules: [$PWD/plugin/boundary-impedance.so]
domain:
  $(echo "$box" | sed 's/], /]\n  /g')
  boundaries:
    $in: {type: incoming-wave, pulse: gaussian, amplitude: 1 kPa, center: 100 us, width: 30 us}
    $3$4: $2
    $(echo "$other" | sed 's/, /\n    /')
mesh: {tile: 8}
materials: {water: {eos: {type: stiffened-gas, gamma: 6.59, p-inf: 4049 atm}}}
initial: [{everywhere: true, material: water, density: 1000, pressure: 1 atm}]
scheme: {cfl: 0.8}
run: {until: 1.3 ms}
output:
  directory: out
  history: {every: 1 step}
  probes: {middle: {at: $at, fields: [pressure]}}
END
}
# The pulse passes the middle at 0.1 + 0.304 ms and comes back at 0.1 + 0.913 ms.
reflected() { # NAME: sum of p' dt there and back
    awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "middle.pressure") c = i; next }
        { dt = $1 - t; t = $1; if (t < 6.5e-4) there += ($c - 101325) * dt; else back += ($c - 101325) * dt }
        END { print back / there }' "$1/out/probes.csv"
}
close_to() { # WHAT VALUE WANTED TOLERANCE
    echo "$1: $2, $3 by the formula"
    awk -v a="$2" -v b="$3" -v e="$4" 'BEGIN { d = a - b; exit !((d < 0 ? -d : d) <= e) }' || fail "$1: $2 instead of $3"
}
Z=$(awk 'BEGIN { print sqrt(1000 * 6.59 * (101325 + 4049 * 101325)) }')
for wall in 0 0.2 1 5 1e4; do
    impedance=$(awk -v a=$wall -v b="$Z" 'BEGIN { printf "%.6f", a * b }')
    R=$(awk -v a=$wall 'BEGIN { print (a - 1)/(a + 1) }')
    tube "wall-$wall" "{type: impedance, impedance: $impedance}" x +
    ran "of-$wall" "wall-$wall"
    close_to "R of a wall of $wall Z" "$(reflected "of-$wall")" "$R" 0.003
done
tube rigid reflecting x +
ran of-rigid rigid
close_to "R of a rigid wall" "$(reflected of-rigid)" 1 0.003
for face in 'x -' 'y +' 'y -'; do
    set -- $face
    tube "face-$1$2" "{type: impedance, preset: pvc}" "$1" "$2"
    ran "at-$1$2" "face-$1$2"
    close_to "R of PVC at $1$2" "$(reflected "at-$1$2")" "$(awk -v b="$Z" 'BEGIN { print (3.27e6 - b)/(3.27e6 + b) }')" 0.003
done

# A bubble between two such walls, with levels that reach them: ranks, restart.
cat >bubble.yaml <<END
bulla: 1
title: A bubble beside walls that give way
modules: [$PWD/plugin/boundary-impedance.so]
domain:
  lower: [0, 0]
  upper: [1 mm, 1 mm]
  cells: [32, 32]
  boundaries: {x-: symmetry, x+: {type: impedance, preset: steel}, y-: {type: impedance, impedance: 0.3 MPa s/m}, y+: non-reflecting}
mesh: {tile: 8, levels: 1, refine: [{interface: air}, {jump: pressure, above: 0.3 bar}]}
materials:
  water: {eos: {type: stiffened-gas, gamma: 6.59, p-inf: 4049 atm}, viscosity: 1 mPa s}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 20 atm}
  - {sphere: {center: [0.8 mm, 0.15 mm], radius: 0.1 mm}, material: air, density: 1.2, pressure: 1 atm}
run: {until: 1 s, max-steps: 40}
output:
  directory: out
  checkpoints: {every: 20 steps}
  snapshots: {every: 40 steps, fields: [pressure, velocity, vorticity]}
  history: {every: 1 step, columns: {V: {volume: air}, p: {max: pressure}, m: {mass: air}}}
expect: [{value: "max(abs(m/first(m) - 1))", at-most: 1e-12}]
END
ranked bubble 1 2 3
resumed bubble 20 bubble-1

# A piston that stands still (the skeleton) is a rigid wall to the bit: mirrored layers, stretches of a solid, levels.
cat >rigid.yaml <<END
bulla: 1
title: A wave in a solid and a gas between mirrors
modules: [$BULLA_BUILD/tests/skeleton/boundary-the-name.so]
domain:
  lower: [0, 0]
  upper: [1, 1]
  cells: [32, 32]
  boundaries:
    x-: reflecting
    x+: reflecting
    y-: reflecting
    y+: outflow
mesh: {tile: 8, levels: 1, refine: [{interface: block}, {jump: pressure, above: 20 kPa}]}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  block:
    eos: {type: stiffened-gas, gamma: 4.4, p-inf: 1 MPa}
    constitutive: {type: neo-hookean, shear-modulus: 100 kPa, reference-density: 1000}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}
  - {sphere: {center: [0.3, 0.4], radius: 0.15}, material: air, density: 3, pressure: 4e5}
  - {half-space: {point: [0.7, 0], normal: [1, 0.3]}, material: block, density: 1000, pressure: 1e5}
run: {until: 1, max-steps: 40}
output:
  directory: out
  history:
    every: 1 step
    columns:
      E: {total: energy}
      u: {integral: "= velocity_x * (1 + x) + velocity_y * (2 + y)"}
      s: {integral: "= stress_xy * (1 + x * y) + pressure"}
END
sed 's/: reflecting/: {type: the-name, velocity: 0}/' rigid.yaml >piston.yaml
ran as-rigid rigid
ran as-piston piston -n 2
cmp as-rigid/out/history.csv as-piston/out/history.csv || fail "a piston that stands still is no rigid wall"

# Rest.
sed 's/1 atm}/20 atm}/; s/^run:.*/run: {until: 2 us}/; s/max: pressure}/max: pressure}, least: {min: pressure}, u: {max: velocity_y}/; /viscosity/s/, viscosity: 1 mPa s//' bubble.yaml |
    sed '/^expect/d; s/V: {volume: air}, //; s/, m: {mass: air}//; /sphere/d; /air:/d; s/{interface: air}, //' >rest.yaml
ran at-rest rest
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
    $c["p"] != $c["least"] || $c["u"] != 0 { exit 1 }' at-rest/out/history.csv || fail "what rests moves" at-rest/out/history.csv

# Told and checked.
"$BULLA" check bubble.yaml >out 2>&1 || fail "check" out
grep -q 'x+  *boundary:impedance  impedance 4.57e+07 Pa s/m' out || fail "check does not tell of it" out
grep -q '"impedance"' bubble-1/out/provenance.json || fail "it is not in the provenance"
BULLA_MODULE_PATH=$PWD/plugin:$BULLA_MODULE_PATH "$BULLA" modules impedance >out
grep -q 'impedance  *Pa s/m  *1.5e+06  *0 to 1e+12' out && grep -q 'boundaries: {x+: {type: impedance, preset: pvc}}' out ||
    fail "it is not documented" out
wrong() { # PATTERN BOUNDARY
    tube wrong "$2" x +
    code=0
    "$BULLA" check wrong.yaml >out 2>&1 || code=$?
    [ $code = 2 ] && grep -qE -- "$1" out || fail "'$2' does not say '$1'" out
}
wrong "wrong.yaml:[0-9]+:[0-9]+: error: unknown key 'impedanze' in domain.boundaries.x\+ \(impedance\)" '{type: impedance, impedanze: 3}'
wrong "did you mean 'impedance'" '{type: impedance, impedanze: 3}'
wrong "wrong.yaml:[0-9]+:[0-9]+: error: domain.boundaries.x\+.impedance: '3 mm' is a length" '{type: impedance, impedance: 3 mm}'
wrong "domain.boundaries.x\+.impedance: -1 " '{type: impedance, impedance: -1}'
wrong "domain.boundaries.x\+.type: .*impedanse" '{type: impedanse}'
wrong "did you mean 'impedance'" '{type: impedanse}'
wrong "pvc" '{type: impedance, preset: wood}'

# A module with the name of a type of the program is told of, and not used.
sed 's/"impedance",$/"outflow",/' "$BULLA_SOURCE/tests/plugin/impedance.c" >outflow.c
${CC:-cc} -O2 -fPIC -shared -ffp-contract=off -fvisibility=hidden -fopenmp-simd -I"$BULLA_SOURCE/core/include" outflow.c -o boundary-outflow.so
tube named outflow x +
sed -i "s|plugin/boundary-impedance.so|boundary-outflow.so|" named.yaml
"$BULLA" check named.yaml >out 2>&1 || fail "a name that is taken" out
grep -qE "named.yaml:[0-9]+:[0-9]+: warning: domain.boundaries.x\+.type: 'outflow' is that of the program" out || fail "no warning" out
