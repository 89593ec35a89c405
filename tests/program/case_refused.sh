# A bad case: exit 2, every mistake with its place, nothing written; options of the command line are checked alike.
set -eu
good=$BULLA_SOURCE/tests/data/case/good/minimal.yaml
bad=$BULLA_SOURCE/tests/data/case/bad/several.yaml

run() { # wanted exit code, then arguments
    wanted=$1
    shift
    code=0
    "$BULLA" "$@" >out.txt 2>err.txt || code=$?
    [ "$code" -eq "$wanted" ] || { echo "bulla $*: exit $code, not $wanted"; cat out.txt err.txt; exit 1; }
}

run 2 run "$bad"
grep -q "^$bad:8:10: error: domain.cells: 2 integers" err.txt
grep -q "^$bad:15:45: error: materials.water.eos.gamma" err.txt
grep -q "^ *8 |   cells: \[64\]" err.txt
grep -q "|  *^" err.txt
[ "$(grep -c ': error: ' err.txt)" -ge 4 ]
[ ! -e out ]

run 2 check "$good" "$bad"
grep -q "several.yaml:8:10: error" err.txt
run 0 check "$good"

run 2 run "$good" --set domain.cells=[ten]
grep -q "^--set domain.cells=\[ten\]: error: domain.cells\[0\]: an integer is needed" err.txt
run 2 run "$good" --variant quick
grep -q "the case has no variants" err.txt
run 2 run nowhere.yaml
grep -q "cannot read 'nowhere.yaml'" err.txt
[ ! -e out ]

# What a case asks for and this version does not do is said.
run 0 check "$good" --set output.checkpoints.every=1us
grep -q "warning: this version writes no checkpoints yet" err.txt
