# Commands that look and run nothing: check, plan, show, modules, info, schema.
set -eu
cp "$BULLA_SOURCE/tests/data/cli/tube.yaml" .
say() { # CODE PATTERN ARGS...
    wanted=$1 pattern=$2
    shift 2
    code=0
    "$BULLA" "$@" >out 2>err || code=$?
    [ "$code" = "$wanted" ] || { echo "$*: exit code $code, not $wanted"; cat out err; exit 1; }
    cat out err >both
    grep -qE -- "$pattern" both || { echo "$*: does not say '$pattern':"; cat both; exit 1; }
}

say 0 '64 cells in 4 tiles of 16' check tube.yaml
grep -q 'fields .*total_energy' out
grep -q 'air .*ideal-gas .*gamma 1.4' out
grep -qE 'about [0-9]+ steps' out
[ ! -e out/tube ] # nothing was run
sed 's/cells: \[64\]/cells: [0]/; s/gamma: 1.4/gama: 1.4/' tube.yaml >bad.yaml
say 2 'bad.yaml:10:' check tube.yaml bad.yaml
grep -q 'tube.yaml: good' out
grep -q "did you mean 'gamma'" err
say 2 '"line":10' check --json bad.yaml

# The steps that are announced are about those that are taken.
announced=$("$BULLA" check tube.yaml | sed -n 's/.*about \([0-9]*\) steps$/\1/p')
"$BULLA" run tube.yaml -o run --quiet
taken=$(tail -n 1 run/history.csv | cut -d, -f1)
[ "$announced" -gt $((taken / 2)) ] && [ "$announced" -lt $((taken * 2)) ] || { echo "$announced, $taken steps"; exit 1; }

say 0 'hllc' plan tube.yaml
say 0 '^ *cells: \[32\]' show tube.yaml --set domain.cells=[32]
"$BULLA" show tube.yaml --variant wrong >again.yaml
say 1 FAIL run again.yaml -o again
say 0 '^ *mc ' modules
say 0 'p-inf +Pa' modules stiffened-gas
say 2 'stiffened-gas' modules stifened-gas
say 0 'density +kg/m3' info run/fields/tube_000000.hdf
say 2 'tube.yaml' info tube.yaml
say 0 'ended .*exit code 0' info run # a directory: the run
grep -q 'level 0 .*tiles, 64 cells' out
grep -qE 'of CPU time; [0-9.e+]+ ns per cell and stage' out
grep -q 'guard .*nothing to do' out
if grep -q 'ranks share' out; then echo 'one rank shares'; exit 1; fi
say 0 'expected +0 of 1 hold' info again
say 2 'no run is here.*give the output directory' info .
"$BULLA" run tube.yaml -o shared --quiet -n 2 --set domain.cells=[640] --set run.until=1e-3 --set run.max-steps=80
say 0 'ranks share it by [01]\.[0-9]* \(weights\), [01]\.[0-9]* \(CPU time\)' info shared
say 2 'nowhere' info nowhere.hdf
say 0 '"\$schema"' schema
