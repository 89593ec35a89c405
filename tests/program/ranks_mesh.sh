# Levels, links, posts and tile sets on 3 ranks, trees of messages also on 7 (at night, BULLA_WHOLE, on 2, 3 and 4, and on 5
# and 7): what one rank sends is what the other expects, tiles move with their numbers, cuts come to every rank, no rank knows all tiles while it writes a file, and
# all checks of the unit tests hold on every rank.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_rmaps_base_oversubscribe=1
for name in gather post levels link patch nest deal roll portions; do
    ranks_of_name=3
    if [ $name = gather ]; then ranks_of_name="3 7"; fi
    if [ -n "${BULLA_WHOLE:-}" ]; then ranks_of_name="2 3 4"; fi
    if [ -n "${BULLA_WHOLE:-}" ] && [ $name = gather ]; then ranks_of_name="2 3 4 5 7"; fi
    for ranks in $ranks_of_name; do
        limited mpirun -n $ranks --bind-to none "$BULLA_BUILD/tests/test-unit-$name" >log 2>&1 ||
            { echo "$name on $ranks ranks"; cat log; exit 1; }
        [ "$(grep -c 'PASSED' log)" -ge $ranks ]
    done
done
