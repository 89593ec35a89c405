# Names: what a file defines begins with the file's name, so that the name tells the room; its own too, so that no name
# sends a reader to another room.
set -eu
command -v ctags >/dev/null || { echo "skipped: no ctags"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$BULLA_SOURCE"
{ find core -name '*.[ch]' ! -name '*_test.c'; find modules -name '*.c'; } | sort >"$scratch/files"
[ -s "$scratch/files" ]
ctags -f - --languages=C --langmap=C:.c.h --kinds-C=fv --fields=+fk-t --sort=no -L "$scratch/files" | awk -F '\t' '
    {
        file = $2
        header = file ~ /\.h$/
        local = 0
        for (i = 4; i <= NF; i++) if ($i ~ /^file:/) local = 1
        room = file
        sub(/.*\//, "", room)
        sub(/\.[ch]$/, "", room)
        if ($1 == "bulla_module" || file ~ /skeleton/) next
        if (local && !header && tolower($1) ~ "^" room "_") next
        if ($1 != room && index($1, room "_") != 1) {
            print file ": " $1 " should begin with " room "_"
            bad = 1
        }
    }
    END { exit bad }'
