# Sizes: a file has at most 500 lines, a function at most 80; every source opens with prose.
set -eu
command -v ctags >/dev/null || { echo "skipped: no ctags"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$BULLA_SOURCE"
find core modules tests -name '*.[ch]' ! -path 'tests/data/*' | sort >"$scratch/files"
[ -s "$scratch/files" ]
status=0
xargs awk '
    FNR == 1 && !/^\/\*/ { print FILENAME ":1: open with a comment: what lives here and why"; bad = 1 }
    FNR == 501 { print FILENAME ": more than 500 lines: split the room"; bad = 1 }
    END { exit bad }' <"$scratch/files" || status=1
ctags -f - --languages=C --langmap=C:.c.h --kinds-C=f --fields=+ne --sort=no -L "$scratch/files" | awk -F '\t' '
    {
        first = last = 0
        for (i = 4; i <= NF; i++) {
            if ($i ~ /^line:/) first = substr($i, 6)
            if ($i ~ /^end:/) last = substr($i, 5)
        }
        if (last - first + 1 > 80) {
            print $2 ":" first ": " $1 " has " last - first + 1 " lines; 80 are allowed"
            bad = 1
        }
    }
    END { exit bad }' || status=1
exit $status
