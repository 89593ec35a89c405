# Tags are the same on any number of ranks: the unit test judges each rank's cells against the whole domain.
set -eu
for ranks in 2 3; do
    (cd "$BULLA_SOURCE" && mpirun -n "$ranks" --oversubscribe --allow-run-as-root --mca mpi_yield_when_idle 1 \
        --bind-to none --mca btl_vader_single_copy_mechanism none "$BULLA_BUILD/tests/test-unit-tag") >said.txt 2>&1 ||
        { cat said.txt; exit 1; }
    [ "$(grep -c 'PASSED.* 10 test' said.txt)" -eq "$ranks" ]
done
