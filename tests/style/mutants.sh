# The table of seeded mistakes (tests/mutants): every text that is to be spoilt is there, once, and every mistake names tests
# that exist. Nothing is built.
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$BULLA_SOURCE"
find core modules -name '*.[ch]' | LC_ALL=C sort >"$scratch/sources"
awk -f tests/mutants/seeds.awk tests/mutants/seeds.txt "$scratch/sources" >"$scratch/table"
[ -s "$scratch/table" ]
cd "$scratch"
for folder in unit module program; do
    find "$BULLA_SOURCE/tests/$folder" -name '*.c' -o -name '*.sh' |
        sed "s|.*/|$folder-|; s|\.[a-z]*\$||; s|_|-|g"
done >tests
cut -f 1,4 table | while read -r name tests; do
    grep -qE -- "$tests" tests || { echo "seeds.txt: $name: no test is called '$tests'"; exit 1; }
done
