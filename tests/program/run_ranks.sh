# Ranks: -n N and mpirun give the same numbers as one process, and exit codes arrive.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cp "$BULLA_SOURCE/tests/data/cli/tube.yaml" .
"$BULLA" run tube.yaml -o one --overwrite --quiet
"$BULLA" run tube.yaml -o two --overwrite --quiet -n 2 >said 2>&1
[ ! -s said ] || { echo "-n 2 --quiet says:"; cat said; exit 1; }
cmp one/history.csv two/history.csv
cmp one/probes.csv two/probes.csv

mpirun -n 3 --oversubscribe --allow-run-as-root --mca mpi_yield_when_idle 1 --bind-to none \
    "$BULLA" run tube.yaml -o three --overwrite --quiet
cmp one/history.csv three/history.csv

# Two of three tiles rest when the second step ends: 1.2 on one rank and 0.2 on the other.
"$BULLA" run tube.yaml -o third --overwrite --quiet -n 2 --set domain.cells='[48]' --max-steps 3
grep -q '"predicted": 0.58333' third/provenance.json || fail "the balance of two ranks is wrong" third/provenance.json

exits() { # WANTED ARGS...
    wanted=$1
    shift
    complete "$BULLA" run "$@" >said 2>&1
    [ "$code" = "$wanted" ] || fail "run $*: exit code $code, not $wanted" said
}
exits 1 tube.yaml --variant wrong -o wrong --overwrite -n 2
exits 2 tube.yaml -o two -n 2
[ "$(grep -c 'holds a run' said)" = 1 ] || { echo "not said once:"; cat said; exit 1; }
exits 2 tube.yaml -o never -n 2 --set run.until=-1
[ "$(grep -c 'not above 0' said)" = 1 ] || { echo "not said once:"; cat said; exit 1; }
exits 2 tube.yaml -o never -n none
exits 3 tube.yaml -o tube.yaml/below -n 2
if grep -q 'mpirun has exited' said; then exit 1; fi
