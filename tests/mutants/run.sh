#!/bin/sh
# run.sh [NAME...] - seeds the mistakes of seeds.txt (or those of these names), one at a time, into a copy of the tree,
# builds what has changed and runs the tests that should see it. The copy and its build are in build-mutants/, or in
# $BULLA_MUTANTS_BUILD; they stay, and the next run builds little. -n says what would be run; -a runs all unit tests, too,
# for what its own tests miss; -s SHARES takes the seeds of one night of so many: number BULLA_NIGHT, the day of the year.
#
# One line per seed: `killed` by a test, `survived` them all, `elsewhere` if only -a finds it, `known` to survive for the
# reason in the table, `found` though it was known to survive, or `broken` if it does not compile or its tests do not exist.
# results.txt there has the lines, results/NAME.log what was said. Ends with 1 if a seed survived that was not known to, was
# broken, or does not apply.
set -eu
cd "$(dirname -- "$0")/../.."
root=$PWD
build=${BULLA_MUTANTS_BUILD:-$root/build-mutants}
case $build in /*) ;; *) build=$root/$build ;; esac
tree=$build/tree
everything=
plan=
shares=1
while getopts ans: option; do
    case $option in
    a) everything='^(unit|module)-' ;;
    n) plan=1 ;;
    s) shares=$OPTARG ;;
    *) exit 2 ;;
    esac
done
shift $((OPTIND - 1))
wanted=" $* "

sources() { find core modules -name '*.[ch]' | LC_ALL=C sort; }

mkdir -p "$build/results"
sources >"$build/sources"
table=$build/table
night=${BULLA_NIGHT:-$(date +%j)}
awk -f tests/mutants/seeds.awk tests/mutants/seeds.txt "$build/sources" >"$build/all" || exit 1
awk -v shares="$shares" -v night="$night" 'NR % shares == night % shares' "$build/all" >"$table"
[ "$shares" = 1 ] || echo "night $night (BULLA_NIGHT): $(wc -l <"$table") of $(wc -l <"$build/all") seeds"
[ -z "$plan" ] || { cat "$table"; exit 0; }

# A fresh copy, with the times of the files, so that what was built of it stays; but files that a run has spoilt are new.
rm -rf "$tree"
mkdir -p "$tree"
for entry in $(git ls-files | cut -d / -f 1 | sort -u); do
    cp -pR "$entry" "$tree/"
done
[ ! -f "$build/spoilt" ] || sort -u "$build/spoilt" | while read -r file; do
    [ ! -f "$tree/$file" ] || touch "$tree/$file"
done

# -O1 and one instruction set: values do not depend on either, and it builds three times as fast.
launcher=
command -v ccache >/dev/null && launcher=-DCMAKE_C_COMPILER_LAUNCHER=ccache
cmake -S "$tree" -B "$build/build" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_C_COMPILER="${CC:-gcc}" \
    -DCMAKE_C_FLAGS="-O1 -DBULLA_NO_CLONES" -DBULLA_WERROR=OFF $launcher >"$build/configure.log" 2>&1 ||
    { cat "$build/configure.log"; exit 1; }
jobs=${BULLA_MUTANTS_JOBS:-1}
ctest -N --test-dir "$build/build" | awk '$1 == "Test" { print $3 }' >"$build/tests"

# What has to be built for a test: a unit test is a program; the others run the program, some of them programs of unit
# tests, on several ranks or to compare files. Modules are loaded by all, three libraries that tests bring by some.
targets() { # REGEX
    grep -E -- "$1" "$build/tests" | while read -r test; do
        case $test in
        unit-* | module-*) echo "test-$test" ;;
        program-ranks-mesh) sed -n '/^for name in/{s///;s/; do//;s/ \([a-z]\)/ test-unit-\1/gp;}' tests/program/ranks_mesh.sh ;;
        *) echo program test-unit-snapshot test-unit-checkpoint test-unit-forged ;;
        esac
    done
    echo tait-murnaghan fault skeleton-boundary
    ninja -C "$build/build" -t targets all | sed -n 's/^\(module-[a-z0-9-]*\): phony$/\1/p'
}

make_targets() { # REGEX
    # shellcheck disable=SC2046
    cmake --build "$build/build" -j "$jobs" --target $(targets "$1" | tr ' ' '\n' | sort -u)
}

# `timeout` ends the whole group, ranks of a stuck message included.
passes() { # REGEX
    timeout -k 10 900 ctest --test-dir "$build/build" -R "$1" --timeout 300 --stop-on-failure --output-on-failure \
        --no-tests=error
}

judge() { # NAME FILE TESTS REASON: prints the verdict
    if ! grep -E -- "$3" "$build/tests" || ! make_targets "$3"; then
        verdict=broken
    elif ! passes "$3"; then
        verdict=killed
    elif [ -n "$everything" ] && make_targets "$everything" && ! passes "$everything"; then
        verdict=elsewhere
    else
        verdict=survived
    fi >"$build/results/$1.log" 2>&1
    case $verdict$4 in
    survived?*) verdict=known ;;
    killed?*) verdict=found ;;
    esac
    echo $verdict
}

restore() { # FILE
    cp -p "$root/$1" "$tree/$1"
    touch "$tree/$1"
}

tab=$(printf '\t')
if [ "$wanted" = "  " ]; then # what fails without a mistake kills nothing
    names=$(cut -f 4 "$table" | sort -u | while read -r tests; do grep -E -- "$tests" "$build/tests" || true; done | sort -u)
    regex="^($(echo $names | tr ' ' '|'))\$"
    make_targets "$regex" >"$build/build.log" 2>&1 || { tail -n 40 "$build/build.log"; exit 1; }
    rm -f "$build/spoilt"
    passes "$regex" >"$build/clean.log" 2>&1 || { tail -n 40 "$build/clean.log"; exit 1; }
fi

status=0
: >"$build/results.txt"
trap 'exit 130' INT TERM
while IFS=$(printf '\001') read -r name file line tests reason said; do
    case $wanted in "  " | *" $name "*) ;; *) continue ;; esac
    echo "$file" >>"$build/spoilt"
    awk -v seed="$name" -f tests/mutants/seeds.awk tests/mutants/seeds.txt "$build/sources" >"$build/mutant"
    cat "$build/mutant" >"$tree/$file"
    verdict=$(judge "$name" "$file" "$tests" "$reason" </dev/null)
    restore "$file"
    case $verdict in survived | broken) status=1 ;; esac
    printf '%-9s %s (%s:%s): %s\n' "$verdict" "$name" "$file" "$line" "$said" | tee -a "$build/results.txt"
done <<TABLE
$(tr "$tab" '\001' <"$table")
TABLE
awk '{ count[$1]++ } END { for (verdict in count) printf "%d %s\n", count[verdict], verdict }' "$build/results.txt" | sort -rn
exit $status
