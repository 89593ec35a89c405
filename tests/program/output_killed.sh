# A killed run leaves readable files: whole rows, whole snapshots under their names, and a provenance that says
# "running".
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cat >tube.yaml <<'END'
bulla: 1
title: A tube
domain: {lower: [0], upper: [1], cells: [512], boundaries: {x-: outflow, x+: outflow}}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: 1 bar}
  - {half-space: {point: [0.5], normal: [1]}, material: air, density: 0.125, pressure: 0.1 bar}
run: {until: 1 s}
output:
  snapshots: {every: 10 steps}
  history: {columns: {mass: {total: mass}}}
END
rm -rf out
begun() { [ -e out/fields/tube_000050.hdf ] || ! alive "$run"; }
start "$BULLA" run tube.yaml -o out --quiet
await "snapshots" begun
alive "$run" || fail "the run ended by itself"
killed "$run"
grep -q '"exit_reason": "running"' out/provenance.json
awk -F, 'NR == 1 { n = NF } NF != n { print "line " NR " has " NF " columns, not " n; exit 1 }' out/history.csv
[ "$(tail -c 1 out/history.csv | od -An -c | tr -d ' ')" = '\n' ] || { echo "the last row is broken"; exit 1; }
for file in out/fields/*.hdf; do
    "$BULLA" info "$file" >info.txt || { echo "$file cannot be read"; exit 1; }
    grep -q '^density ' info.txt
done
