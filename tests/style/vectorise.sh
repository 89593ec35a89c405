# Vectorisation: every loop marked `omp simd` in modules and the layers of the equations becomes a vector loop with gcc,
# which builds the program, and at night (BULLA_WHOLE) with clang, which says so when it fails. What has passed is kept
# by its preprocessed text and not compiled again. Where the build has kept gcc's reports (CMakeLists.txt; not with ccache,
# which keeps none), what is a vector of four there is not compiled for this at all. Laws of a family bring the same loops
# from the family's headers: a file all of whose loops were seen with another file is left to the night, too, as these
# take longest.
set -eu
whole=${BULLA_WHOLE:-}
[ -z "$whole" ] || command -v clang >/dev/null || { echo "skipped: no clang"; exit 77; }
flags="-std=c11 -D_GNU_SOURCE -DBULLA_NO_CLONES -O3 -march=x86-64-v3 -fno-math-errno -fno-trapping-math -fopenmp-simd
-ffp-contract=off -fPIC -I$BULLA_SOURCE/modules/eos -I$BULLA_SOURCE/core/include -I$BULLA_SOURCE/core $(pkg-config --cflags ompi-c)"
status=0
passed=$BULLA_BUILD/tests/vectorised
mkdir -p "$passed"
: >seen
compilers=$(gcc --version; [ -z "$whole" ] || clang --version; cat "$0")
left() { # REPORT SOURCE: the loops of a source that are vectors nowhere in gcc's report
    awk -v file="$2" -v tail="${2#"$BULLA_SOURCE/"}" '
        FILENAME == ARGV[1] {
            split($0, part, ":")
            if (substr(part[1], length(part[1]) - length(tail) + 1) == tail && /loop vectorized/) done[part[2]] = 1
            next
        }
        # gcc names a line of the loop or of its body: look from the `for` to the brace that ends it.
        /#pragma omp simd/ { marked = 1; next }
        marked && /^[ \t]*for[ \t]*\(/ {
            marked = found = 0
            first = FNR
            match($0, /^[ \t]*/)
            end = substr($0, 1, RLENGTH) "}"
            braced = /{[^}]*$/
        }
        first {
            if (FNR in done) found = 1
            if (braced ? index($0, end) != 1 : !/;[ \t]*(\/\*.*)?$/) next
            if (!found) { print file ":" first ": gcc left this loop scalar"; bad = 1 }
            first = 0
        }
        END { exit bad }' "$1" "$2"
}
text() { # FILE: what the compilers are and see, without names of lines and folders
    # shellcheck disable=SC2086
    { echo "$compilers"; gcc $flags -E -P "$1"; } | sha256sum | cut -d ' ' -f 1
}
for file in "$BULLA_SOURCE"/modules/*/*.c "$BULLA_SOURCE"/modules/*/*/*.c "$BULLA_SOURCE"/core/phys/*.c \
    "$BULLA_SOURCE"/core/scheme/*.c "$BULLA_SOURCE"/core/levels/*.c "$BULLA_SOURCE"/core/derive/*.c "$BULLA_SOURCE"/core/paint/*.c; do
    # The loops of a module may live in a header beside it, or in one that families share.
    marked=$(gcc $flags -MM "$file" | tr -d '\\' | tr ' ' '\n' | grep -E "^(${file%/*}|$BULLA_SOURCE/modules/[a-z]*/shared)/[^/]*$" |
        xargs grep -l '#pragma omp simd' || true)
    [ -n "$marked" ] || continue
    echo "$file" >>looked
    built=$(ls "$BULLA_BUILD"/CMakeFiles/*.dir/"${file#"$BULLA_SOURCE/"}.o.vec" 2>/dev/null || true)
    if [ -z "$whole" ] && [ -n "$built" ]; then
        grep '32 byte vectors' "$built" >vectorised || true
        good=1
        for source in $marked; do left vectorised "$source" >/dev/null || good=; done
        [ -z "$good" ] || continue
    fi
    if [ -z "$whole" ] && [ -z "$(echo "$marked" | grep -vxF -f seen)" ]; then continue; fi
    echo "$marked" >>seen
    name=$(text "$file")
    [ ! -f "$passed/$name" ] || continue
    good=1
    # shellcheck disable=SC2086
    [ -z "$whole" ] || clang $flags -Wpass-failed -Werror=pass-failed -c "$file" -o clang.o || good=
    # shellcheck disable=SC2086
    gcc $flags -c "$file" -o gcc.o -fopt-info-vec-optimized=vectorised
    for source in $marked; do left vectorised "$source" || good=; done
    if [ -n "$good" ]; then : >"$passed/$name"; else status=1; fi
done
[ "$(wc -l <looked)" -ge 30 ] || { echo "only $(wc -l <looked) files have loops: where are the others?"; exit 1; }
exit $status
