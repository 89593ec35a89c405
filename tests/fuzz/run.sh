#!/bin/sh
# run.sh [SECONDS [TARGET...]] - builds the fuzz targets with clang's libFuzzer, ASan and UBSan (build-fuzz/) and runs
# each for so many seconds (300), one after the other, from the corpus in the tree. Inputs that are new go to
# build-fuzz/found/TARGET, crashes to build-fuzz/crash/. Ends with 1 if any target crashed, leaked, hung or grew.
set -eu
cd "$(dirname -- "$0")/../.."
seconds=${1:-300}
[ $# -eq 0 ] || shift
cmake --preset fuzz >/dev/null
cmake --build build-fuzz -j2 --target fuzz >build-fuzz/build.log 2>&1 || { tail -n 40 build-fuzz/build.log; exit 1; }
[ $# -gt 0 ] || set -- case checkpoint cli elf formula script table
export ASAN_OPTIONS="quarantine_size_mb=8:malloc_context_size=8:detect_stack_use_after_return=0:allocator_may_return_null=1"
export LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp:print_suppressions=0"
mkdir -p build-fuzz/crash
build-fuzz/bin/bulla schema | tr -c 'a-zA-Z0-9-' '\n' | sort -u | awk 'length > 2 && length < 24 { print "\"" $0 "\"" }' \
    >build-fuzz/words # what cases are made of
status=0
for name; do
    mkdir -p "build-fuzz/found/$name"
    log=build-fuzz/$name.log
    "build-fuzz/fuzz/fuzz-$name" "$PWD/build-fuzz/found/$name" "$PWD/tests/fuzz/corpus/$name" -max_total_time="$seconds" \
        -timeout=4 -rss_limit_mb=256 -artifact_prefix="$PWD/build-fuzz/crash/$name-" -print_final_stats=1 \
        -dict=build-fuzz/words >"$log" 2>&1 || status=1
    awk -v name="$name" '/stat::/ { value[$1] = $2 } /SUMMARY|ERROR: libFuzzer/ { said = said "\n  " $0 }
        END { printf "%-11s %s executions, peak %s MB%s\n", name, value["stat::number_of_executed_units:"],
            value["stat::peak_rss_mb:"], said }' "$log"
done
exit $status
