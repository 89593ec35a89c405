# A term of the equations that the tour of docs/extending.md adds: a porous layer slows a jet. The same bits on 1, 2 and 3 ranks
# and after a restart, with levels; mass and energy to round-off; the plan shows the term and its file.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >porous.yaml <<'END'
bulla: 1
title: A wave meets a porous layer
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8, levels: 1, refine: [{jump: pressure, above: 20 kPa}]}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  foam: {eos: {type: ideal-gas, gamma: 1.4}, drag: 5e3}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}
  - {sphere: {center: [0.3, 0.4], radius: 0.15}, material: air, density: 3, pressure: 4e5}
  - {half-space: {point: [0.6, 0], normal: [1, 0]}, material: foam, density: 1.2, pressure: 1e5}
scheme: {cfl: 0.4}
run: {until: 1 ms, max-steps: 30}
output:
  directory: out
  checkpoints: {every: 10 steps}
  history: {columns: {m: {mass: foam}, M: {mass: air}, E: {total: energy}, u: {max: velocity_x}}}
expect:
  - {value: "abs(last(m)/first(m) - 1)", at-most: 1e-12}
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-12}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-12}
END
ranked porous 1 2 3
resumed porous 10 porous-1

"$BULLA" plan porous.yaml >plan
grep -q '^  drag .*foam 5000 kg/m3/s .*core/scheme/drag.c' plan || { cat plan; exit 1; }
"$BULLA" plan porous.yaml --set materials.foam.drag=0 >without
! grep -q drag without || { cat without; exit 1; }

# It slows.
"$BULLA" run porous.yaml -o free --set materials.foam.drag=0 --quiet
awk -F, 'FNR == 1 { for (i = 1; i <= NF; i++) if ($i == "u") c = i } { last[FILENAME] = $c } END { exit !(last["porous-1/out/history.csv"] < last["free/history.csv"]) }' \
    porous-1/out/history.csv free/history.csv
