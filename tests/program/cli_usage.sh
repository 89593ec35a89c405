# Usage: help lists what there is, wrong words get a suggestion and exit code 2.
set -eu
expect() { # CODE PATTERN ARGS...: exit code, and what the output (both streams) says
    wanted=$1 pattern=$2
    shift 2
    code=0
    "$BULLA" "$@" >out 2>&1 || code=$?
    [ "$code" = "$wanted" ] || { echo "bulla $*: exit code $code, not $wanted"; cat out; exit 1; }
    grep -qE -- "$pattern" out || { echo "bulla $*: does not say '$pattern':"; cat out; exit 1; }
}

expect 0 '^bulla [0-9]+\.[0-9]+\.[0-9]+' version
expect 0 '^bulla [0-9]' --version
expect 0 'COMMAND' help
expect 0 'COMMAND' --help
expect 0 '^bulla version' help version
expect 0 '^bulla version' version -h
expect 2 'COMMAND'
expect 2 "did you mean 'version'" verson
expect 2 'bulla help' zzzzzzzzzzzz
expect 2 "did you mean 'version'" help versio
expect 2 'bulla new module KIND NAME' new law eos mine
expect 2 'launcher' test

# Every command is listed.
"$BULLA" help >out
for word in run check plan show sweep modules new module verify plot report info schema; do
    grep -q "^  $word " out || { echo "bulla help does not list $word"; exit 1; }
done
