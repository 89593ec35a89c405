#!/bin/sh
# mpich.sh [PROGRAM] - builds bulla with MPICH and serial HDF5, warnings as errors, runs its tests, and compares the
# histories of 1, 2 and 3 ranks with each other and with those of PROGRAM (bulla built with Open MPI), bit by bit: a plane
# wave, and levels that move. Build and results are in build-mpich, or in $BULLA_MPICH_BUILD. Needs libmpich-dev, mpich
# and libhdf5-dev beside what bulla needs, else it ends with 77. Nightly; .ci/mpich does it in a Debian that has nothing
# yet. BULLA_MPICH_TESTS: a regular expression for ctest, if not all tests are wanted.
set -eu
command -v mpicc.mpich >/dev/null || { echo "there is no mpicc.mpich"; exit 77; }
root=$(cd -- "$(dirname -- "$0")/.." && pwd)
other=${1:-${BULLA-}}
build=${BULLA_MPICH_BUILD:-$root/build-mpich}
launcher=
command -v ccache >/dev/null && launcher=-DCMAKE_C_COMPILER_LAUNCHER=ccache
cmake -S "$root" --preset ci -B "$build" -DMPI_C_COMPILER=mpicc.mpich $launcher
cmake --build "$build" -j "$(nproc)"
grep -q 'define BULLA_OPEN_MPI 1\|BULLA_OPEN_MPI=1' "$build/build.ninja" && { echo "this is Open MPI"; exit 1; }
# Style is that of the tree; the others start ranks by themselves, in Open MPI's dialect.
dialect='^style-|^nightly-|^program-(case-tags|queue|ranks-mesh|run-ranks)$'
ctest --test-dir "$build" --output-on-failure --no-tests=error -j "$(nproc)" -R "${BULLA_MPICH_TESTS:-.}" -E "$dialect"

place=$build/histories
rm -rf "$place"
mkdir -p "$place"
bulla=$build/bin/bulla
cd "$place"
same() { # NAME CASE OPTIONS...
    name=$1
    shift
    for ranks in 1 2 3; do
        "$bulla" run "$@" -o "$name-$ranks" -n $ranks --quiet --set expect=null --set output.snapshots=null
        cmp "$name-1/history.csv" "$name-$ranks/history.csv"
        [ -z "$other" ] || {
            "$other" run "$@" -o "other-$name-$ranks" -n $ranks --quiet --set expect=null --set output.snapshots=null
            cmp "$name-1/history.csv" "other-$name-$ranks/history.csv"
        }
    done
}
same tube "$root/cases/tour/tube.yaml" --set 'domain.cells=[100]'
same levels "$root/cases/verify/e4-levels.yaml" --variant quick --max-steps 60
echo "MPICH: tests pass, histories are the same on 1, 2 and 3 ranks${other:+, and those of $other}"
