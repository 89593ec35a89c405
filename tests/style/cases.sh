# Cases: every scene says what it is, where it comes from and what it must show. A file may
# take these from the one it extends; files without a domain (materials) are no scenes.
set -eu
cd "$BULLA_SOURCE"
status=0
has() { # KEY FILE: in the file or in what it extends
    grep -qE "^$1:" "$2" && return 0
    parent=$(sed -n 's/^extends:[ ]*//p' "$2" | head -n 1)
    [ -n "$parent" ] || return 1
    has "$1" "$(dirname "$2")/$parent"
}
for file in $(find cases -name '*.yaml' 2>/dev/null | sort); do
    has domain "$file" || continue
    for key in title about cite expect; do
        has "$key" "$file" && continue
        echo "$file: no $key:"
        status=1
    done
done
exit $status
