# docs/modules.md quotes the tested plugin: every line of its code blocks is a line of tests/plugin.
set -eu
cd "$BULLA_SOURCE"
awk '/^```(c|cmake)$/ { inside = 1; next } /^```/ { inside = 0 } inside && NF' docs/modules.md >"$OLDPWD/quoted"
[ "$(wc -l <"$OLDPWD/quoted")" -gt 20 ]
status=0
while IFS= read -r line; do
    grep -qxF -- "$line" tests/plugin/tait_murnaghan.c tests/plugin/CMakeLists.txt || {
        echo "docs/modules.md: not in tests/plugin: $line"
        status=1
    }
done <"$OLDPWD/quoted"
exit $status
