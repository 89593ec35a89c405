# lib.sh - what tests in shell share: `. "$BULLA_SOURCE/tests/lib.sh"`. No test depends on how fast the machine is, or on
# luck: it waits for what it needs (await), not for a time; it looks at files when every process of a run is gone
# (ended, killed); what it draws comes from a seed that it prints (draw, noise; BULLA_SEED sets another one); what is
# still running when it ends is killed. Where a signal may come too late, it is sent to another run (insist).
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" # Open MPI leaks by itself

fail() { # MESSAGE [FILE...]: ends the test; shows the files
    echo "$1"
    shift
    [ $# -eq 0 ] || cat "$@"
    exit 1
}
refused() { # PATTERN COMMAND...: ends with exit code 2 and one line, which says PATTERN
    refused_pattern=$1
    shift
    code=0
    "$@" >out 2>err || code=$?
    [ "$code" = 2 ] || fail "exit code $code: $*" err
    grep -q -- "$refused_pattern" err || fail "no '$refused_pattern' in:" err
    [ "$(wc -l <err)" = 1 ] || fail "more than a line:" err
}
lib_limit=600 # s; only what hangs takes so long
limited() { timeout -k 5 "$lib_limit" "$@"; } # COMMAND...: 124 if it hangs

# --- waiting ---
await() { # WHAT COMMAND...: until the command succeeds
    await_what=$1 await_tries=0
    shift
    until "$@"; do
        await_tries=$((await_tries + 1))
        [ "$await_tries" -lt "$((lib_limit * 100))" ] || fail "this never came: $await_what"
        sleep 0.01
    done
}
insist() { # COMMAND...: a try that may come too late, until one does not
    insist_tries=0
    until "$@"; do
        insist_tries=$((insist_tries + 1))
        [ "$insist_tries" -lt 50 ] || fail "too late in each of 50 tries, or without effect: $*" said
    done
}

# --- processes: each run is a session of its own, which its ranks cannot leave ---
lib_sessions=
start() { # COMMAND...: in the background; $run is its process and its session
    # A shell starts background jobs with SIGINT ignored; env makes it count again.
    setsid env --default-signal=INT "$@" &
    run=$!
    lib_sessions="$lib_sessions $run,"
}
alive() { # PROCESS: it is there, in $state (R S D T, see proc(5)); one that has ended and is not waited for (Z) is not
    state=none
    read -r _ _ state _ 2>/dev/null <"/proc/$1/stat" && [ "$state" != Z ]
}
members() { # SESSION: its processes
    ps -o pid=,stat= -s "$1" | awk '$2 !~ /^Z/ { print $1 }'
}
gone() { [ -z "$(members "$1")" ]; }
ended() { # SESSION: waits for all its processes; $code is the exit code of the first
    code=0
    wait "$1" || code=$?
    await "the end of all processes of session $1" gone "$1"
    lib_sessions="${lib_sessions%% "$1",*}${lib_sessions#* "$1",}"
}
lingers() { # SESSION: is its first process there after a minute, too? For what may hang by no fault of the program
    lingers_tries=0
    while alive "$1" && [ "$lingers_tries" -lt 6000 ]; do
        lingers_tries=$((lingers_tries + 1))
        sleep 0.01
    done
    alive "$1"
}
complete() { # COMMAND...: until its last process is gone, also where a rank ends before the others; $code
    start "$@"
    ended "$run"
}
kill_all() { # SESSION: and whatever starts meanwhile
    kill -9 "$1" 2>/dev/null || true
    until gone "$1"; do
        # shellcheck disable=SC2046
        kill -9 $(members "$1") 2>/dev/null || true
    done
}
killed() { # SESSION: kills it and waits as `ended` does
    kill_all "$1"
    ended "$1"
}
at_end=: # a command
lib_end() {
    for lib_session in $(echo "$lib_sessions" | tr -d ,); do gone "$lib_session" || kill_all "$lib_session"; done
    eval "$at_end"
}
trap lib_end EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
trap 'exit 129' HUP

# --- the same bits: histories, probes, all snapshots and what the guard did ---
# Each run has a folder of its own, in which names are the same: a snapshot holds the case, and this the name of its output.
ran() { # FOLDER CASE OPTIONS...: runs a copy of CASE.yaml there; its output is FOLDER/out
    ran_folder=$1 ran_case=$2
    shift 2
    mkdir -p "$ran_folder"
    cp "$ran_case.yaml" "$ran_folder"
    (cd "$ran_folder" && "$BULLA" run "$ran_case.yaml" -o out --quiet "$@" </dev/null)
}
told() { # FOLDER PART: what provenance says of it, but for times
    sed -n "/\"$2\"/,/}/p" "$1/out/provenance.json" | sed '/cpu/d; /share/d'
}
alike() { # FOLDER FOLDER: two runs
    for alike_file in history.csv probes.csv; do
        [ ! -e "$1/out/$alike_file" ] || cmp "$1/out/$alike_file" "$2/out/$alike_file"
    done
    for alike_file in "$1"/out/fields/*.hdf; do
        [ ! -e "$alike_file" ] || "$BULLA_BUILD/tests/test-unit-snapshot" "$alike_file" "$2/out/fields/${alike_file##*/}"
    done
    for alike_part in guard refinement; do
        told "$1" $alike_part >"$1/$alike_part"
        told "$2" $alike_part >"$2/$alike_part"
        cmp "$1/$alike_part" "$2/$alike_part"
    done
}
ranked() { # CASE RANKS...: runs CASE.yaml on the first and the last of these numbers of ranks, at night (BULLA_WHOLE) on all of
    # them, in CASE-RANKS; all are like the first
    ranked_case=$1 ranked_first=$2
    shift
    for ranked_last; do :; done
    [ -n "${BULLA_WHOLE:-}" ] || [ $# -lt 3 ] || set -- "$ranked_first" "$ranked_last"
    for ranked_now in "$@"; do
        rm -rf "$ranked_case-$ranked_now"
        ran "$ranked_case-$ranked_now" "$ranked_case" -n "$ranked_now"
        alike "$ranked_case-$ranked_first" "$ranked_case-$ranked_now"
    done
}
resumed() { # CASE STEPS FOLDER: ends CASE.yaml after STEPS on two ranks, goes on with it on one; the history is that of the
    # run in FOLDER (older snapshots and counts are of the first part)
    rm -rf "$1-resumed"
    ran "$1-resumed" "$1" -n 2 --max-steps "$2"
    ran "$1-resumed" "$1" --restart
    cmp "$3/out/history.csv" "$1-resumed/out/history.csv"
}

# --- numbers ---
lib_random=${BULLA_SEED:-1}
echo "seed $lib_random (BULLA_SEED)"
# Scenes that several tests run, each with an `output:` of its own, which follows.

parting() { # SCHEME STEPS: streams that part too fast for an explicit step: cells are marked and repaired, steps repeated
    cat <<END
bulla: 1
title: Streams that part too fast for an explicit step
domain: {lower: [-1, -1], upper: [1, 1], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic}}
mesh: {tile: 8}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - everywhere: true
    material: water
    density: 1000
    pressure: 1 bar
    velocity: ['= x > 0 and 700 or -700', '= y > 0 and 700 or -700']
  - {sphere: {center: [0.1, 0.1], radius: 0.3}, material: air, density: 1, pressure: 1 bar, velocity: [0, 0]}
scheme: {$1, limiter: mc, dt: 20 us} # too long
run: {until: 1, max-steps: $2, smallest-step: 0} # it creeps: what counts is that all ranks do
END
}
drifting() { # CELLS STEPS: a scene of so many cells along a side, with two more levels that come, move and go
    cat <<END
bulla: 1
title: A bubble and a blast drift through a periodic box
domain: {lower: [0, 0], upper: [1, 1], cells: [$1, $1], boundaries: {x-: periodic, x+: periodic, y-: reflecting, y+: outflow}}
mesh: {levels: 3, tile: 4, regrid-every: 2, buffer: 2, patience: 2, refine: [{jump: alpha_air, above: 0.2}, {jump: pressure, above: 0.8, finest: 2}]}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: [300, 90]}
  - {sphere: {center: [0.3, 0.5], radius: 0.08}, material: water, density: 1100, pressure: 2e8}
  - {sphere: {center: [0.85, 0.6], radius: 0.1}, material: air, density: 1.2, pressure: 1e5, velocity: [300, 90]}
run: {until: 1, max-steps: $2}
END
}
resting() { # INTEGRATOR STEPS: nothing moves where nothing happens, and it is all skipped
    cat <<END
bulla: 1
title: At rest
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: reflecting, x+: outflow, y-: reflecting, y+: outflow}}
mesh: {tile: 8}
materials: {water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}}
initial: [{everywhere: true, material: water, density: 1000, pressure: 1 bar}]
scheme: {integrator: $1}
run: {until: 1, max-steps: $2}
output: {history: {columns: {p: {max: pressure}, q: {min: pressure}, u: {max: velocity_x}}}}
expect: [{value: "max(p) - min(q)", at-most: 0}, {value: max(u), at-most: 0}]
END
}

draw() { # MOST: sets $drawn, 0 to MOST - 1
    lib_random=$(((lib_random * 1103515245 + 12345) % 2147483648))
    drawn=$((lib_random / 64 % $1))
}
noise() { # BYTES: so many, of all values
    # shellcheck disable=SC2059
    printf '%b' "$(awk -v n="$1" -v s="$lib_random" 'BEGIN {
        for (i = 0; i < n; i++) { s = (s * 69069 + 1) % 4294967296; printf "\\0%03o", int(s / 16777216) }
    }')"
}
