# Signals and the wall clock: the step is finished, the state is saved, exit code 4.
set -eu
cp "$BULLA_SOURCE/tests/data/cli/tube.yaml" .
rm -rf out
long="--set run.until=1e3 --set output.snapshots.every=1e3 --overwrite"

await() { # FILE: until the run has written two rows
    tries=0
    until [ "$(wc -l <"$1/history.csv" 2>/dev/null || echo 0)" -gt 3 ]; do
        tries=$((tries + 1))
        [ $tries -lt 1000 ] || { echo "the run does not begin"; exit 1; }
        sleep 0.02
    done
}
stopped() { # PID DIR SIGNAL
    code=0
    wait "$1" || code=$?
    [ "$code" = 4 ] || { echo "$3: exit code $code, not 4"; cat said; exit 1; }
    grep -q "interrupted.*$3" said || { echo "$3 is not mentioned:"; cat said; exit 1; }
    [ "$(ls "$2/fields" | grep -c '\.hdf$')" -ge 1 ] || { echo "no snapshot of the last state"; exit 1; }
    [ "$(tail -c 1 "$2/history.csv" | wc -l)" = 1 ] || { echo "the last row is cut"; exit 1; }
    [ -s "$2/provenance.json" ]
}

for signal in INT TERM USR1; do
    # A shell starts background jobs with SIGINT ignored; env makes it count again.
    # shellcheck disable=SC2086
    env --default-signal=INT "$BULLA" run tube.yaml -o $signal $long >said 2>&1 &
    await $signal
    kill -s $signal $!
    stopped $! $signal $signal
done

# Through mpirun, where the parent passes the signal on.
# shellcheck disable=SC2086
env --default-signal=INT "$BULLA" run tube.yaml -o ranks $long -n 2 >said 2>&1 &
await ranks
kill -s INT $!
stopped $! ranks INT

# shellcheck disable=SC2086
"$BULLA" run tube.yaml -o clock $long --walltime 0 >said 2>&1 &
stopped $! clock walltime
