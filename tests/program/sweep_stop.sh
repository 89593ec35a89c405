# A sweep that is stopped or killed goes on where it was, and in the end every combination has the bits of a run that
# nobody touched. Two sweeps never work in one directory, nor does a new one beside the runs of one that was killed.
# BULLA_KILLS: how often it is killed (6).
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cat >tube.yaml <<'END'
bulla: 1
title: A tube
parameters: {p_1: 1 bar}
domain: {lower: [0], upper: [1], cells: [128], boundaries: {x-: outflow, x+: reflecting}}
mesh: {tile: 64}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: = p_1}
  - {half-space: {point: [0.5], normal: [1]}, material: air, density: 0.125, pressure: 0.1 bar}
run: {until: 1e3, max-steps: 8000}
output:
  checkpoints: {every: 500 steps}
  history: {every: 20 steps, columns: {m: {total: mass}}}
matrix:
  parameters.p_1: [1 bar, 2 bar, 3 bar]
  scheme.limiter: [mc, minmod]
END
sweep() { "$BULLA" sweep tube.yaml -o out -j 3 "$@"; }
rows() { cat out/*/history.csv 2>/dev/null | wc -l; }
further() { [ "$(rows)" -gt "$wanted" ] || ! alive "$run"; }
go_until() { # ROWS more of histories, or the end, of the sweep that was started
    wanted=$(($(rows) + $1))
    await "rows of histories" further
}
finished() {
    for folder in whole/*/; do
        name=$(basename "$folder")
        for file in history.csv case.yaml; do
            sed "s/directory: .*//" "$folder$file" >a
            sed "s/directory: .*//" "out/$name/$file" >b
            cmp a b || fail "$name/$file differs"
        done
    done
    [ "$(cut -d, -f1-5 out/table.csv)" = "$(cut -d, -f1-5 whole/table.csv)" ] || fail "another table" out/table.csv
}
"$BULLA" sweep tube.yaml -o whole --quiet >table
[ "$(wc -l <table)" = 7 ]

# Signals: the runs save, the sweep ends with exit code 4, the same command goes on.
interrupt() { # SIGNAL RANKS; false: too late, a run has finished
    rm -rf out
    start "$BULLA" sweep tube.yaml -o out -j 2 -n "$2" >table 2>said
    go_until 30
    kill -s "$1" "$run" 2>/dev/null || true
    ended "$run"
    ! grep -q ': done in' said
}
for signal in INT TERM; do
    ranks=1
    [ $signal = INT ] || ranks=2
    insist interrupt $signal $ranks
    [ $code = 4 ] || fail "exit code $code, not 4" said
    grep -q ': interrupted' said && grep -q 'the same command goes on' said || fail "not said" said
    [ "$(wc -l <table)" = 7 ] || fail "not a table of all" table
    sweep --dry-run >list
    grep -q '^to go on' list && grep -q '^to be run' list || fail "nothing is left to do" list
    sweep >table 2>said
    finished
done

# A sweep at work, with a run that does not move until it is told to: `victim`. Tried anew if all have finished before that.
halted() { ! alive "$victim" || [ "$state" = T ]; }
halt() {
    rm -rf out
    start "$BULLA" sweep tube.yaml -o out -j 3 >table 2>said
    go_until 5
    for victim in $(ps -o pid= --ppid "$run"); do
        kill -STOP "$victim" 2>/dev/null || continue
        await "a halt" halted
        [ "$state" != T ] || return 0
    done
    ended "$run"
    return 1
}
insist halt
first=$run

# While one is at work, another is refused; it may work elsewhere.
code=0
sweep >refused 2>&1 || code=$?
[ $code = 2 ] && grep -q "another sweep (process $first) is at work" refused || fail "exit code $code" refused

# A run that is killed is reported, the others go on; a later call takes it up.
readlink /proc/$victim/fd/* | grep -q '/out/sweep.lock$' || fail "the run holds no lock: $(ls -l /proc/$victim/fd)"
kill -9 $victim
ended $first
[ $code = 3 ] || fail "exit code $code, not 3" said
[ "$(grep -c 'failed with exit code 3' said)" = 1 ] && grep -q '1 of 6 combinations failed' said || fail "not said" said
sweep >table 2>said
grep -q ' 5 of them finished before' said
finished

# Its runs hold a lock as well, and a sweep waits for what holds it: runs of one that was killed.
start sh -c 'exec 9>>out/sweep.lock && flock 9 && : >held && exec tail -f /dev/null'
holder=$run
await "the lock" test -e held
start "$BULLA" sweep tube.yaml -o out -j 3 >table 2>said
await "a word about the runs" grep -q 'waiting for the runs' said
! grep -q combinations said || fail "it did not wait" said
killed $holder
ended "$run"
[ $code = 0 ] || fail "exit code $code" said
finished

# The sweep itself is killed at moments that are drawn: its runs save and end, the next one waits for them.
rm -rf out
kills=0 rounds=0
while [ $kills -lt "${BULLA_KILLS:-6}" ]; do
    rounds=$((rounds + 1))
    [ $rounds -le $((20 * ${BULLA_KILLS:-6})) ] || fail "only $kills kills in $rounds sweeps"
    draw 600
    start "$BULLA" sweep tube.yaml -o out -j 3 >table 2>said
    go_until $drawn
    kill -9 "$run" 2>/dev/null || true
    code=0
    wait "$run" || code=$?
    case $code in
    137) kills=$((kills + 1)) ;;
    0)
        finished
        rm -rf out
        ;;
    *) fail "exit code $code" said ;;
    esac
done
sweep >table 2>said || fail "it does not go on" said
finished
