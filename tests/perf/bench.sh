#!/bin/sh
# Speed and memory of the whole program beside those of its bare kernels, on this machine and now. No test.
#
#     tests/perf/bench.sh [BUILD]
#
# For each case: CPU time per cell and stage, the bare kernels of the same machine, their ratio, and what
# peak memory grows by per cell and field from 512 x 512 to 1024 x 1024 cells, in doubles (three arrays are stored).
# Then two ranks against one: wall time of the whole run, start and end included. Runs on an idle machine only
# mean something.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "${1:-$here/../../build}" && pwd)
export BULLA_MODULE_PATH="${BULLA_MODULE_PATH:-$build/lib/bulla/modules}"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

number() { # FILE KEY: a number of provenance.json
    sed -n "s/^ *\"$2\": *\([-0-9.e+]*\),*\$/\1/p" "$1" | head -n 1
}

run() { # CASE RANKS [OPTIONS...]: runs into CASE-RANKS
    case=$1 ranks=$2
    shift 2
    "$build/bin/bulla" run "$here/$case.yaml" -o "$case-$ranks" -n "$ranks" --quiet --overwrite "$@"
}

report() { # CASE FIELDS KERNEL_NS
    of="$1-1/provenance.json"
    run "$1" 1 --max-steps 1 --set 'domain.cells=[1024, 1024]'
    many=$(number "$of" cells) most=$(number "$of" peak_memory_bytes)
    run "$1" 1
    awk -v name="$1" -v fields="$2" -v bare="$3" -v ns="$(number "$of" cpu_ns_per_cell_stage)" \
        -v bytes="$(number "$of" peak_memory_bytes)" -v cells="$(number "$of" cells)" -v many="$many" -v most="$most" \
        'BEGIN {
        printf "%-14s %6.1f ns per cell-stage, bare kernels %5.1f, ratio %.2f; %.2f doubles per cell and field\n",
               name, ns, bare, ns / bare, (most - bytes) / (many - cells) / 8 / fields }'
}

kernels=$("$build/bin/bulla-bench-kernels" 2>/dev/null | head -n 1)
two=$(echo "$kernels" | sed -n 's/.*two materials 2D \([0-9.]*\) ns.*/\1/p')
one=$(echo "$kernels" | sed -n 's/.*one material 2D \([0-9.]*\) ns.*/\1/p')
[ -n "$two" ] && [ -n "$one" ] || { echo "bench: cannot read '$kernels'" >&2; exit 1; }

report shock_bubble 7 "$two"
report explosion 4 "$one"
run shock_bubble 2
alone=$(number shock_bubble-1/provenance.json wall_s)
both=$(number shock_bubble-2/provenance.json wall_s)
awk -v one="$alone" -v two="$both" 'BEGIN {
    printf "%-14s %6.2f s on 1 rank, %.2f s on 2 ranks: %.2f times as fast\n", "shock_bubble", one, two, one / two }'
