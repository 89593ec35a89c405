# Every example in docs/cases.md is a case that `bulla check` accepts. A block's first line names its file; files that
# others extend or read stand in blocks of their own. The case in the README too.
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
awk '/^```(yaml|csv|lua)$/ { inside = 1; name = ""; next }
     /^```/ { inside = 0; next }
     inside && name == "" { name = $2; sub(/:$/, "", name); print name }
     inside { print > name }' "$BULLA_SOURCE/docs/cases.md" >names
[ "$(grep -c yaml names)" -ge 10 ]
cp "$BULLA_SOURCE/tests/data/body/octahedron.stl" stone.stl
awk '/^```yaml$/ { inside = 1; next } /^```/ { inside = 0 } inside' "$BULLA_SOURCE/README.md" >readme.yaml
for case in $(grep yaml names) readme.yaml; do
    "$BULLA" show "$case" >shown 2>said || { cat said; exit 1; }
    [ ! -s said ] || { cat said; exit 1; }
done
