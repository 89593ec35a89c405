# docs/modules.md quotes the tested plugin: every line of its code blocks is a line of tests/plugin.
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$BULLA_SOURCE"
awk '/^```(c|cmake)$/ { inside = 1; next } /^```/ { inside = 0 } inside && NF' docs/modules.md >"$scratch/quoted"
[ "$(wc -l <"$scratch/quoted")" -gt 20 ]
status=0
while IFS= read -r line; do
    grep -qxF -- "$line" tests/plugin/tait_murnaghan.c tests/plugin/CMakeLists.txt || {
        echo "docs/modules.md: not in tests/plugin: $line"
        status=1
    }
done <"$scratch/quoted"
exit $status
