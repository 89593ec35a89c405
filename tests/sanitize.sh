#!/bin/sh
# sanitize.sh [CTEST OPTION...] - the whole tree under AddressSanitizer and UBSan: configures and builds the preset
# `sanitize` (in build-sanitize/, with ccache where it is), runs the tests of the preset of the same name, or those of them
# that the options choose (-R '^unit-', -j4), and says what failed and the time. Reports of sanitizers are gathered from every
# process, also from one whose test expects it to fail, and from ranks. Ends with 1 if a test failed or a sanitizer spoke.
# Everything said: build-sanitize/sanitize.log; the reports: build-sanitize/found/.
#
# Leaks are looked for in unit tests and in runs without ranks; tests that start MPI switch that off, since Open MPI leaks by
# itself. Not in the preset: style tests, which read the source, and the hunts of fuzz/run.sh, which have sanitizers of their own.
set -eu
cd "$(dirname -- "$0")/.."
build=$PWD/build-sanitize
log=$build/sanitize.log
found=$build/found
launcher=
! command -v ccache >/dev/null || launcher=-DCMAKE_C_COMPILER_LAUNCHER=ccache
rm -rf "$found"
mkdir -p "$found"
{ cmake --preset sanitize $launcher && nice cmake --build --preset sanitize -j2; } >"$log" 2>&1 || { tail -n 40 "$log"; exit 1; }

status=0
ASAN_OPTIONS=log_path=$found/report UBSAN_OPTIONS=log_path=$found/report nice ctest --preset sanitize "$@" >"$log" 2>&1 || status=1
sed -n '/tests passed,\|^No tests/,$p' "$log"
for report in "$found"/*; do
    [ -e "$report" ] || continue
    status=1
    grep -hE 'ERROR: |runtime error: ' "$report" || head -n 3 "$report"
    grep -m1 -hE '#[0-9]+ .*(core|modules|tests)/' "$report" || true
done
exit $status
