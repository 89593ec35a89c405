# A sweep that is stopped or killed goes on where it was, and in the end every combination has the bits of a run that
# nobody touched. Two sweeps never work in one directory, nor does a new one beside the runs of one that was killed.
# BULLA_KILLS: how often it is killed (6).
set -eu
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" # Open MPI leaks by itself
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
await() { # ROWS more of histories, of the sweep PID
    wanted=$(($(rows) + $1))
    until [ "$(rows)" -gt "$wanted" ]; do
        kill -0 "$2" 2>/dev/null || return 0
        sleep 0.01
    done
}
finished() {
    for folder in whole/*/; do
        name=$(basename "$folder")
        for file in history.csv case.yaml; do
            sed "s/directory: .*//" "$folder$file" >a
            sed "s/directory: .*//" "out/$name/$file" >b
            cmp a b || { echo "$name/$file differs"; exit 1; }
        done
    done
    [ "$(cut -d, -f1-5 out/table.csv)" = "$(cut -d, -f1-5 whole/table.csv)" ] || { cat out/table.csv; exit 1; }
}
"$BULLA" sweep tube.yaml -o whole --quiet >table
[ "$(wc -l <table)" = 7 ]

# Signals: the runs save, the sweep ends with exit code 4, the same command goes on. A signal that comes too late, after a
# run has finished, is sent anew to another sweep: how soon this script gets its turn is not what is tested.
interrupt() { # SIGNAL RANKS; false: too late
    rm -rf out
    env --default-signal=INT "$BULLA" sweep tube.yaml -o out -j 2 -n "$2" >table 2>said &
    await 30 $!
    kill -s "$1" $! 2>/dev/null || true
    code=0
    wait $! || code=$?
    ! grep -q ': done in' said
}
for signal in INT TERM; do
    ranks=1 tries=0
    [ $signal = INT ] || ranks=2
    until interrupt $signal $ranks; do
        tries=$((tries + 1))
        [ $tries -lt 50 ] || { echo "$signal never comes in time, or does nothing"; cat said; exit 1; }
    done
    [ $code = 4 ] || { echo "exit code $code, not 4"; cat said; exit 1; }
    grep -q ': interrupted' said && grep -q 'the same command goes on' said || { cat said; exit 1; }
    [ "$(wc -l <table)" = 7 ] || { cat table; exit 1; }
    sweep --dry-run >list
    grep -q '^to go on' list && grep -q '^to be run' list || { cat list; exit 1; }
    sweep >table 2>said
    finished
done

# A sweep at work, with a run that does not move until it is told to: `victim`. Tried anew if all have finished before that.
halt() {
    rm -rf out
    "$BULLA" sweep tube.yaml -o out -j 3 >table 2>said &
    first=$!
    await 5 $first
    for victim in $(ps -o pid= --ppid $first); do
        kill -STOP "$victim" 2>/dev/null || continue
        while state=$(ps -o stat= -p "$victim") && case $state in [RSD]*) ;; *) false ;; esac; do :; done
        case $state in T*) return 0 ;; esac
    done
    wait $first || true
    return 1
}
tries=0
until halt; do
    tries=$((tries + 1))
    [ $tries -lt 50 ] || { echo "no run can be stopped"; cat said; exit 1; }
done

# While one is at work, another is refused; it may work elsewhere.
code=0
sweep >refused 2>&1 || code=$?
[ $code = 2 ] && grep -q "another sweep (process $first) is at work" refused || { cat refused; exit 1; }

# A run that is killed is reported, the others go on; a later call takes it up.
readlink /proc/$victim/fd/* | grep -q '/out/sweep.lock$' || { ls -l /proc/$victim/fd; exit 1; }
kill -9 $victim
code=0
wait $first || code=$?
[ $code = 3 ] || { echo "exit code $code, not 3"; cat said; exit 1; }
[ "$(grep -c 'failed with exit code 3' said)" = 1 ] && grep -q '1 of 6 combinations failed' said || { cat said; exit 1; }
sweep >table 2>said
grep -q ' 5 of them finished before' said
finished

# Its runs hold a lock as well, and a sweep waits for what holds it: runs of one that was killed.
(exec 9>>out/sweep.lock && flock 9 && : >held && exec sleep 300) &
holder=$!
until [ -e held ]; do kill -0 $holder; sleep 0.01; done
sweep >table 2>said &
until grep -q 'waiting for the runs' said; do kill -0 $!; sleep 0.01; done
! grep -q combinations said || { echo "it did not wait"; exit 1; }
kill $holder
wait $!
finished

# The sweep itself is killed at random moments: its runs save and end, the next one waits for them.
rm -rf out
kills=0
number() { od -An -N2 -tu2 /dev/urandom | awk -v most="$1" '{ print $1 % most }'; }
while [ $kills -lt "${BULLA_KILLS:-6}" ]; do
    "$BULLA" sweep tube.yaml -o out -j 3 >table 2>said &
    sweep=$!
    sleep "0.$((10 + $(number 40)))"
    kill -9 $sweep 2>/dev/null || true
    code=0
    wait $sweep || code=$?
    case $code in
    137) kills=$((kills + 1)) ;;
    0)
        finished
        rm -rf out
        ;;
    *) echo "exit code $code"; cat said; exit 1 ;;
    esac
done
sweep >table 2>said || { cat said; exit 1; }
finished
