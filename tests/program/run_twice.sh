# A run has its directory to itself: another one is refused, whether it would replace it or go on with it, and the files
# of the first are not touched. When the first is gone, however it ended, the next may begin.
set -eu
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" # Open MPI leaks by itself
cat >tube.yaml <<'END'
bulla: 1
title: A tube
domain: {lower: [0], upper: [1], cells: [256], boundaries: {x-: outflow, x+: reflecting}}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: 1 bar}
  - {half-space: {point: [0.5], normal: [1]}, material: air, density: 0.125, pressure: 0.1 bar}
run: {until: 1e3, max-steps: 400000}
output:
  directory: out
  checkpoints: {every: 200 steps}
  history: {every: 20 steps, columns: {m: {total: mass}}}
END
for ranks in 1 2; do
    rm -rf out
    "$BULLA" run tube.yaml -n $ranks --overwrite >said 2>&1 &
    run=$!
    until [ -n "$(ls out/checkpoints/*.chk 2>/dev/null)" ]; do kill -0 $run; done
    for how in --overwrite --restart "--restart -n 2"; do
        code=0
        # shellcheck disable=SC2086
        "$BULLA" run tube.yaml $how >refused 2>&1 || code=$?
        [ $code = 2 ] && grep -q 'another run is at work in out\|cannot restart' refused || { echo "exit code $code: $how"; cat refused; exit 1; }
    done
    kill -0 $run
    kill -TERM $run
    code=0
    wait $run || code=$?
    [ $code = 4 ] || { echo "exit code $code, not 4"; cat said; exit 1; }
    head -n 1 out/history.csv | grep -q '^step,t,dt,m'
    sed -n 2p out/history.csv | grep -q '^0,'
    awk -F, 'NR > 2 && $1 <= last { exit 1 } { last = $1 + 0 }' out/history.csv # nobody cut it off or began it again
done
rm -rf out
"$BULLA" run tube.yaml --overwrite >said 2>&1 &
run=$!
until [ -n "$(ls out/checkpoints/*.chk 2>/dev/null)" ]; do kill -0 $run; done
kill -9 $run
wait $run 2>/dev/null || true
"$BULLA" run tube.yaml --overwrite --quiet --max-steps 10
