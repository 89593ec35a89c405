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

# A coarsest level larger than --max-memory is no case to start.
run 2 run "$good" --max-memory '100 B'
grep -q "error: --max-memory 100 B: the coarsest level alone takes" err.txt
run 2 check "$good" --max-memory lots
grep -q "'lots' is no amount of memory; write '8 GiB'" err.txt
for size in '' GiB '8 apples' '-1 GiB' 0 '8 GiBs' nan; do run 2 check "$good" --max-memory="$size"; done
[ ! -e out ]
for size in '721 B' 0.72kB 1k '0.5 MiB' 1e9 2GB; do run 0 check "$good" --max-memory="$size"; done
for size in 719 0.7K 0.71kB; do run 2 check "$good" --max-memory="$size"; done

# What a case refines is told.
run 0 check "$BULLA_SOURCE/tests/data/case/good/refine.yaml"
grep -q "levels  *4 above the coarsest, finest cells 976.6 nm; regrid every 5 steps, buffer 3$" out.txt
grep -q "mesh.refine\[1\] (line 19): gradient of pressure above 1e+09 Pa/m, to level 2$" out.txt
grep -q "at the start 4096" out.txt
run 0 check "$BULLA_SOURCE/tests/data/case/good/refine.yaml" --set mesh.levels=0
grep -q "levels  *0: 'refine' is not used" out.txt
