#!/bin/sh
# run.sh [EFFORT [TARGET...]] - builds the fuzz targets with clang's libFuzzer, ASan and UBSan (in build-fuzz/, or
# $BULLA_FUZZ_BUILD) and runs each, one after the other, from the corpus in the tree: for EFFORT seconds (300), or, when it ends
# with an x, for that many executions, which are the same ones every time. BULLA_SEED sets another seed than 1. Inputs
# that are new go to found/TARGET there, crashes to crash/. Ends with 1 if any target crashed, leaked, hung or grew, with
# 77 where there is no clang with libFuzzer.
set -eu
cd "$(dirname -- "$0")/../.."
build=${BULLA_FUZZ_BUILD:-$PWD/build-fuzz}
effort=${1:-300}
seed=${BULLA_SEED:-1}
[ $# -eq 0 ] || shift
mkdir -p "$build"
echo 'int LLVMFuzzerTestOneInput(const char *d, long n); int LLVMFuzzerTestOneInput(const char *d, long n) { return !d && n; }' |
    clang -x c -fsanitize=fuzzer,address -o "$build/probe" - 2>/dev/null || { echo "skipped: no clang with libFuzzer"; exit 77; }
cmake --preset fuzz -B "$build" >/dev/null
cmake --build "$build" -j2 --target fuzz >"$build/build.log" 2>&1 || { tail -n 40 "$build/build.log"; exit 1; }
[ $# -gt 0 ] || set -- case checkpoint cli dump elf formula law script table
export ASAN_OPTIONS="quarantine_size_mb=8:malloc_context_size=8:detect_stack_use_after_return=0:allocator_may_return_null=1"
export LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp:print_suppressions=0"
mkdir -p "$build/crash"
"$build/bin/bulla" schema | tr -c 'a-zA-Z0-9-' '\n' | sort -u | awk 'length > 2 && length < 24 { print "\"" $0 "\"" }' \
    >"$build/words" # what cases are made of
case $effort in
*x) limit=-runs=${effort%x} ;;
*) limit=-max_total_time=$effort ;;
esac
echo "seed $seed (BULLA_SEED)"
status=0
for name; do
    case $effort in *x) rm -rf "$build/found/$name" ;; esac # what another run has found would make it another one
    mkdir -p "$build/found/$name"
    log=$build/$name.log
    "$build/fuzz/fuzz-$name" "$build/found/$name" "$PWD/tests/fuzz/corpus/$name" "$limit" -seed="$seed" \
        -timeout=100 -rss_limit_mb=256 -artifact_prefix="$build/crash/$name-" -print_final_stats=1 \
        -dict="$build/words" >"$log" 2>&1 || status=1
    awk -v name="$name" '/stat::/ { value[$1] = $2 } /SUMMARY|ERROR: libFuzzer/ { said = said "\n  " $0 }
        END { printf "%-11s %s executions, peak %s MB%s\n", name, value["stat::number_of_executed_units:"],
            value["stat::peak_rss_mb:"], said }' "$log"
done
exit $status
