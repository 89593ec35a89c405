# Signals and the wall clock: the step is finished, the state is saved, exit code 4.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cp "$BULLA_SOURCE/tests/data/cli/tube.yaml" .
rm -rf out
long="--set run.until=1e3 --set output.snapshots.every=1e3 --overwrite"

begun() { [ "$(cat "$1/history.csv" 2>/dev/null | wc -l)" -gt 3 ] || ! alive "$run"; }
begin() { # FOLDER OPTIONS...: until the run, which has no end, has written two rows
    folder=$1
    shift
    # shellcheck disable=SC2086
    start "$BULLA" run tube.yaml -o "$folder" $long "$@" >said 2>&1
    await "the first rows" begun "$folder"
}
stopped() { # FOLDER SIGNAL
    ended "$run"
    [ "$code" = 4 ] || fail "$2: exit code $code, not 4" said
    grep -q "interrupted.*$2" said || fail "$2 is not mentioned:" said
    [ "$(ls "$1/fields" | grep -c '\.hdf$')" -ge 1 ] || fail "no snapshot of the last state"
    [ "$(tail -c 1 "$1/history.csv" | wc -l)" = 1 ] || fail "the last row is cut"
    [ -s "$1/provenance.json" ]
}

for signal in INT TERM USR1; do
    begin $signal
    kill -s $signal "$run"
    stopped $signal $signal
done

# Through mpirun, where the parent passes the signal on.
begin ranks -n 2
kill -s INT "$run"
stopped ranks INT

# shellcheck disable=SC2086
start "$BULLA" run tube.yaml -o clock $long --walltime 0 >said 2>&1
stopped clock walltime
