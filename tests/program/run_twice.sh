# A run has its directory to itself: another one is refused, whether it would replace it or go on with it, and the files
# of the first are not touched. When the first is gone, however it ended, the next may begin.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cat >tube.yaml <<'END'
bulla: 1
title: A tube
domain: {lower: [0], upper: [1], cells: [256], boundaries: {x-: outflow, x+: reflecting}}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: 1 bar}
  - {half-space: {point: [0.5], normal: [1]}, material: air, density: 0.125, pressure: 0.1 bar}
run: {until: 1e3} # never
output:
  directory: out
  checkpoints: {every: 200 steps}
  history: {every: 20 steps, columns: {m: {total: mass}}}
END
saved() { [ -n "$(ls out/checkpoints/*.chk 2>/dev/null)" ] || ! alive "$run"; }
for ranks in 1 2; do
    rm -rf out
    start "$BULLA" run tube.yaml -n $ranks --overwrite >said 2>&1
    await "a checkpoint" saved
    some=$(ls out/checkpoints/*.chk | tail -n 1)
    for how in --overwrite --restart "--restart -n 2" "--restart=$some"; do
        code=0
        # shellcheck disable=SC2086
        "$BULLA" run tube.yaml $how >refused 2>&1 || code=$?
        [ $code = 2 ] && grep -q 'another run is at work in out' refused || fail "exit code $code: $how" refused
    done
    alive "$run" || fail "the first run has ended" said
    kill -TERM "$run"
    ended "$run"
    [ $code = 4 ] || fail "exit code $code, not 4" said
    head -n 1 out/history.csv | grep -q '^step,t,dt,m'
    sed -n 2p out/history.csv | grep -q '^0,'
    awk -F, 'NR > 2 && $1 <= last { exit 1 } { last = $1 + 0 }' out/history.csv # nobody cut it off or began it again
done
rm -rf out
start "$BULLA" run tube.yaml --overwrite >said 2>&1
await "a checkpoint" saved
killed "$run"
"$BULLA" run tube.yaml --overwrite --quiet --max-steps 10
