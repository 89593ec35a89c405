#!/bin/sh
# whole.sh BUILD [NAME...] - runs the cases of cases/verify and cases/tour at their own size, with all their variants, and
# looks whether they show what they expect: each test run has their quick variants only, and what a larger mesh brings to
# light is not in those. Without NAME (of a file, without .yaml): those of one night of eight, number BULLA_NIGHT, the day
# of the year; BULLA_WHOLE: all, two hours. A line for each: `held`, `FAILS`, or `known`, which are misses that
# docs/verification.md explains. Ends with 1 if anything else failed; its output stays in BUILD/tests/runs/whole/NAME.txt.
set -eu
[ $# -ge 1 ] || { sed -n '2,7s/^# //p' "$0"; exit 2; }
source=$(cd "$(dirname -- "$0")/.." && pwd)
build=$(cd "$1" && pwd)
shift
known='k14-rise' # the time of its largest velocity is 5 % late
place=$build/tests/runs/whole
rm -rf "$place"
mkdir -p "$place"

tonight() { # FILE lines, an eighth of them
    night=${BULLA_NIGHT:-$(date +%j)}
    if [ -n "${BULLA_WHOLE:-}" ]; then cat
    else awk -v night="$night" 'NR % 8 == night % 8'
    fi
}
chosen() {
    if [ $# -gt 0 ]; then for name; do ls "$source"/cases/*/"$name.yaml" || return 2; done
    else grep -lE '^(domain|extends):' "$source"/cases/verify/*.yaml "$source"/cases/tour/*.yaml | LC_ALL=C sort | tonight
    fi
}
variants() { # FILE: its variants, by name; the empty one first
    echo
    awk '/^[a-z]/ { in_variants = /^variants:/ } in_variants && /^  [a-z0-9-]+:/ { sub(/:.*/, ""); print $1 }' "$1"
}

failed=0
chosen "$@" >"$place/cases"
while read -r file; do
    variants "$file" >"$place/variants"
    while read -r variant; do
        name=$(basename "$file" .yaml)${variant:+-$variant} code=0
        "$build/bin/bulla" run "$file" ${variant:+--variant "$variant"} -o "$place/$name" --overwrite --quiet \
            >"$place/$name.txt" 2>&1 </dev/null || code=$?
        rm -rf "${place:?}/$name"
        word=held
        [ "$code" = 0 ] || case " $known " in *" $name "*) word=known ;; *) word=FAILS failed=1 ;; esac
        echo "$word $name"
        [ "$word" != FAILS ] || tail -n 3 "$place/$name.txt"
    done <"$place/variants"
done <"$place/cases"
exit $failed
