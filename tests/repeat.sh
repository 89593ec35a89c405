#!/bin/sh
# repeat.sh BUILD COUNT LOAD [TEST...] - runs tests of tests/program (their names without .sh) COUNT times each, each time
# with another seed, while LOAD processes keep the machine busy. Without TEST: those of one night of sixteen, number
# BULLA_NIGHT, the day of the year. Says how often each held; what failed stays in BUILD/tests/runs/repeat/TEST-SEED, with
# its output in `output`. A process that a test leaves behind counts as a failure. Ends with 1 if anything failed.
# Ended by a signal (`timeout 300 tests/repeat.sh ...`), it says what has been seen so far. BULLA_REPEAT_SECONDS: no test begins
# again after so long, however often it ran. BULLA_REPEAT_FIRST: the first seed, to go on where it ended; 1 if not given.
set -eu
[ $# -ge 3 ] || { sed -n '2,8s/^# //p' "$0"; exit 2; }
BULLA_SOURCE=$(cd "$(dirname -- "$0")/.." && pwd)
BULLA_BUILD=$(cd "$1" && pwd)
BULLA=$BULLA_BUILD/bin/bulla
BULLA_MODULE_PATH=$BULLA_BUILD/lib/bulla/modules
BULLA_WHOLE=1 # with all that the day leaves out
export BULLA_SOURCE BULLA_BUILD BULLA BULLA_MODULE_PATH BULLA_WHOLE
count=$2 load=$3
shift 3
tonight() {
    night=${BULLA_NIGHT:-$(date +%j)}
    echo "night $night of sixteen (BULLA_NIGHT)" >&2
    for file in "$BULLA_SOURCE"/tests/program/*.sh; do basename "$file" .sh; done | LC_ALL=C sort |
        awk -v night="$night" 'NR % 16 == night % 16'
}
# shellcheck disable=SC2046
[ $# -gt 0 ] || set -- $(tonight)
for test; do
    [ -f "$BULLA_SOURCE/tests/program/$test.sh" ] || { echo "repeat: there is no tests/program/$test.sh" >&2; exit 2; }
done

test=
say() { [ -z "$test" ] || echo "$test: $held of $tried"; }
busy=
trap 'say; for process in $busy; do kill "$process" 2>/dev/null || true; done' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
while [ "$load" -gt 0 ]; do
    nice -n 10 sh -c 'while :; do :; done' &
    busy="$busy $!"
    load=$((load - 1))
done

left() { # FOLDER: processes that still work there
    find /proc -maxdepth 2 -name cwd -lname "$1*" 2>/dev/null | cut -d/ -f3
}
try() { # TEST SEED: in a fresh folder
    place=$BULLA_BUILD/tests/runs/repeat/$1-$2
    rm -rf "$place"
    mkdir -p "$place"
    code=0
    (cd "$place" && BULLA_SEED=$2 sh "$BULLA_SOURCE/tests/program/$1.sh" >output 2>&1) || code=$?
    [ -z "$(left "$place")" ] || { echo "left behind: $(left "$place" | tr '\n' ' ')" >>"$place/output"; code=1; }
    case $code in
    0) rm -rf "$place" ;;
    77) rm -rf "$place" && return 0 ;;
    *) echo "$1 fails with seed $2 (exit code $code): $place/output"; tail -n 5 "$place/output" ;;
    esac
    return $code
}
status=0
for test; do
    held=0 tried=0 end=$(($(date +%s) + ${BULLA_REPEAT_SECONDS:-86400}))
    while [ "$tried" -lt "$count" ] && [ "$(date +%s)" -lt "$end" ]; do
        if try "$test" $((${BULLA_REPEAT_FIRST:-1} + tried)); then held=$((held + 1)); else status=1; fi
        tried=$((tried + 1))
    done
    say
done
test=
exit $status
