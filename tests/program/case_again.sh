# The resolved case that a run leaves behind gives the same run, to the last bit, without the files it came from.
set -eu
mkdir sources
cp "$BULLA_SOURCE"/tests/data/case/good/*.yaml "$BULLA_SOURCE"/tests/data/case/good/vortex.lua sources
for name in expressions lua shapes design; do
    set -- --quiet --max-steps 3 --set 'output.history.columns.p_max={max: pressure}' --set expect=null
    [ "$name" = design ] && set -- "$@" --set 'domain.cells=[16, 32]'
    grep -q '^expect:' "sources/$name.yaml" || set -- --quiet --max-steps 3 --set 'output.history.columns.p_max={max: pressure}'
    "$BULLA" run "sources/$name.yaml" -o "first-$name" "$@" 2>said.txt || { cat said.txt; exit 1; }
done
rm -r sources
for name in expressions lua shapes design; do
    "$BULLA" run "first-$name/case.yaml" -o "again-$name" --quiet
    cmp "first-$name/history.csv" "again-$name/history.csv"
    [ "$(wc -l <"again-$name/history.csv")" -ge 4 ]
done
