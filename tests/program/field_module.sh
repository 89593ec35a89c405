# Fields from outside the tree (tests/plugin/vortex.c): q of a body that turns at w is w^2 in every cell, at edges of tiles,
# across levels and on ranks; of a stream towards a wall, in a plane and around an axis, what the formula says. They stand
# wherever fields do: snapshots, histories, probes, peaks, criteria of refinement, expressions. Same bits on 1, 2 and 3
# ranks and after a restart; names and keys are checked like those of the program.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cmake -G Ninja -S "$BULLA_SOURCE/tests/plugin" -B plugin -Dbulla_DIR="$BULLA_SOURCE/core/include/bulla" >log 2>&1 &&
    cmake --build plugin >>log 2>&1 || fail "the plugins do not build" log
"$BULLA" module check plugin/field-vortex.so >out 2>&1 || fail "vortex does not hold" out

cat >turn.yaml <<END
bulla: 1
title: Air that turns at 100 1/s
modules: [$PWD/plugin/field-vortex.so]
domain: {lower: [-1, -1], upper: [1, 1], cells: [32, 32], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}
mesh:
  tile: 8
  levels: 2
  refine: [{region: {box: {lower: [-0.4, -0.3], upper: [0.5, 0.4]}}}, {value: eddy_q, above: 5000 1/s2, where: {box: {lower: [0.6, -0.8], upper: [0.8, -0.6]}}}]
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
fields:
  eddy: {type: vortex, floor: 1e-6 1/s2}
initial: [{everywhere: true, material: air, density: 1.2, pressure: "= 1e5 + 0.6 * 1e4 * (x^2 + y^2)", velocity: [= -100 * y, = 100 * x]}]
run: {until: 1 s, max-steps: 12}
output:
  directory: out
  checkpoints: {every: 4 steps}
  snapshots: {every: 4 steps, fields: [pressure, eddy_q, eddy_share, max_eddy_q, {turn: "= eddy_q / 1e4"}]}
  history:
    every: 1 step
    columns:
      most: {max: eddy_q, where: {box: {lower: [-0.7, -0.7], upper: [0.7, 0.7]}}}
      least: {min: eddy_q, where: {box: {lower: [-0.7, -0.7], upper: [0.7, 0.7]}}}
      share: {min: eddy_share, where: {box: {lower: [-0.7, -0.7], upper: [0.7, 0.7]}}}
      sum: {integral: eddy_q}
  probes: {here: {at: [0.26, 0.1], fields: [eddy_q]}, there: {at: [0.7, -0.7], fields: [level]}}
expect:
  - {value: first(most), equals: 1e4, relative: 1e-10}
  - {value: first(least), equals: 1e4, relative: 1e-10}
  - {value: first(share), equals: 1, relative: 1e-9}
  - {value: last(here.eddy_q), equals: 1e4, relative: 1e-3} # it goes on turning
  - {value: min(there.level), equals: 2, tolerance: 0} # q has refined it
END
ranked turn 1 2 3
resumed turn 4 turn-1
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "here.eddy_q") c = i } NR == 2 { exit !($c > 9999.999 && $c < 10000.001) }' \
    turn-1/out/probes.csv || fail "the probe is elsewhere" turn-1/out/probes.csv

# A stream towards a wall, u = (-a x, a y), and around an axis, (-a r, 2 a z): q = -a^2, -3 a^2 by |S|^2 alone.
stream() { # NAME GEOMETRY X- VELOCITY Q
    cat >"$1.yaml" <<END
bulla: 1
title: A stream towards a wall
modules: [$PWD/plugin/field-vortex.so]
domain: {geometry: $2, lower: [0, 0], upper: [1, 1], cells: [16, 16], boundaries: {x-: $3, x+: outflow, y-: reflecting, y+: outflow}}
mesh: {tile: 8}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
fields: {eddy: {type: vortex}}
initial: [{everywhere: true, material: air, density: 1.2, pressure: 1e5, velocity: [$4]}]
run: {until: 1 us}
output:
  directory: out
  snapshots: {every: 1 us, fields: [eddy_q, eddy_share]}
  history:
    every: 1 step
    columns:
      most: {max: eddy_q, where: {box: {lower: [0.1, 0.1], upper: [0.9, 0.9]}}}
      least: {min: eddy_q, where: {box: {lower: [0.1, 0.1], upper: [0.9, 0.9]}}}
expect:
  - {value: first(most), equals: $5, relative: $6}
  - {value: first(least), equals: $5, relative: $6}
END
    ran "$1-run" "$1"
}
stream plane cartesian symmetry '= -10 * x, = 10 * y' -100 1e-9
stream axis axisymmetric axis '= -10 * x, = 20 * y' -300 1e-2 # cell means of r have the weight r

# Told and checked.
"$BULLA" check turn.yaml >out 2>&1 || fail "check" out
grep -q 'eddy_q  *field:vortex  floor 1e-06 1/s2' out || fail "check does not tell of it" out
BULLA_MODULE_PATH=$PWD/plugin:$BULLA_MODULE_PATH "$BULLA" modules vortex >out
grep -q 'fields: {NAME: {type: vortex, ...}}' out || fail "it is not documented" out
grep -q 'NAME_share  *1  *Share of the spin' out || fail "its outputs are not documented" out
wrong() { # PATTERN SED-EXPRESSION
    sed "$2" turn.yaml >wrong.yaml
    code=0
    "$BULLA" check wrong.yaml >out 2>&1 || code=$?
    [ $code = 2 ] && grep -qE -- "$1" out || fail "'$2' does not say '$1'" out
}
wrong "wrong.yaml:[0-9]+:[0-9]+: error: unknown key 'flor' in fields.eddy \(vortex\)" 's/floor:/flor:/'
wrong "fields.eddy.floor: '1 mm' is a length" 's/floor: 1e-6 1.s2/floor: 1 mm/'
wrong "there is no field 'eddy_r'" 's/\[pressure, eddy_q/[pressure, eddy_r/'
wrong "did you mean 'eddy_q'" 's/\[pressure, eddy_q/[pressure, edy_q/'
wrong "fields.edd.y: 'edd.y_q' is no identifier" 's/  eddy:/  edd.y:/'
wrong "did you mean 'vortex'" 's/type: vortex,/type: vortx,/'
wrong "did you mean 'fields'" 's/^fields:/field:/'
