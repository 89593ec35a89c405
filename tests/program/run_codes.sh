# Exit codes of real runs, what they leave behind and what they say.
set -eu
cp "$BULLA_SOURCE/tests/data/cli/tube.yaml" .
rm -rf out there
run() { # CODE PATTERN ARGS...
    wanted=$1 pattern=$2
    shift 2
    code=0
    "$BULLA" run "$@" >said 2>&1 || code=$?
    [ "$code" = "$wanted" ] || { echo "run $*: exit code $code, not $wanted"; cat said; exit 1; }
    grep -qE -- "$pattern" said || { echo "run $*: does not say '$pattern':"; cat said; exit 1; }
}

# 0: done, with every file of the contract.
run 0 'finished: t = 100 ms' tube.yaml
for file in case.yaml history.csv probes.csv provenance.json log.txt fields/tube.hdf.series; do
    [ -s "out/tube/$file" ] || { echo "no $file"; exit 1; }
done
head -n 1 out/tube/history.csv | grep -qx 'step,t,dt,mass,most.*'
head -n 1 out/tube/probes.csv | grep -qx 't,middle.pressure'

# Snapshots at 0, 0.05 and 0.1, and these times are exact.
[ "$(ls out/tube/fields | grep -c '\.hdf$')" = 3 ]
grep -qE '"time" *: *0\.05(0000|,|$)' out/tube/fields/tube.hdf.series
awk -F, '$2 == 0.05 { half = 1 } END { exit !(half && $2 == 0.1) }' out/tube/history.csv

# A fixed step that divides the output times makes that many steps, and no slivers.
run 0 '100 steps' tube.yaml --set scheme.dt=1e-3 -o fixed
awk -F, 'NR > 2 && $3 < 0.9e-3 { exit 1 }' fixed/history.csv

# 2: the directory holds a run; the refusal lists it; --overwrite replaces it.
run 2 'holds a run: .*history.csv.*--overwrite' tube.yaml
echo mine >out/tube/notes.txt
run 0 finished --overwrite tube.yaml --set run.until=0.01
[ "$(ls out/tube/fields | grep -c '\.hdf$')" = 2 ] && [ -f out/tube/notes.txt ]

# The resolved case runs again and gives the same numbers.
run 0 finished out/tube/case.yaml -o again
cmp out/tube/history.csv again/history.csv

# 1: an expectation fails. A run that the command line shortens is not judged.
run 1 'FAIL *max' tube.yaml --variant wrong -o wrong
run 0 'not judged' tube.yaml --variant wrong -o short --max-steps 3
[ "$(tail -n 1 short/history.csv | cut -d, -f1)" = 3 ]

# 2: bad case, bad option values; nothing is written.
sed 's/cells: \[64\]/cells: [0]/' tube.yaml >bad.yaml
run 2 'bad.yaml:10:[0-9]+: error: .*domain.cells' bad.yaml -o never
run 2 'domain.cells' tube.yaml --set domain.cells=[0] -o never
run 2 "did you mean" tube.yaml --set run.untill=3 -o never
run 2 'nowhere.yaml' nowhere.yaml -o never
run 2 'did you mean --overwrite' tube.yaml --overwrit
run 2 -- '--until wants a value' tube.yaml --until
run 2 'HH:MM:SS' tube.yaml --walltime soon -o never
run 2 'exclude each other' tube.yaml --quiet --json -o never
run 2 'there is no whole checkpoint in never/checkpoints' tube.yaml --restart -o never
[ ! -e never ]

# 3: the directory cannot be made, nor a folder in it.
echo >file
run 3 'cannot make the output directory' tube.yaml -o file/below
mkdir taken
echo >taken/fields
run 3 'taken/fields' tube.yaml -o taken

# 3: the gas is torn apart; the last good state and the reason are kept.
sed 's/pressure: 1}/pressure: 1, velocity: [-50]}/; s/pressure: 0.1}/pressure: 0.1, velocity: [50]}/' tube.yaml >torn.yaml
run 3 'error: step [0-9]+ at t = .* cannot be completed: .*air.*cell' torn.yaml -o torn --set scheme.guard=strict
grep -q 'last good state' said
[ "$(ls torn/fields | grep -c '\.hdf$')" = 2 ]
grep -q '"exit_code": 3' torn/provenance.json
grep -q '"exit_reason": "step .* cannot be completed' torn/provenance.json

# From another directory; --until with a unit; --quiet is silent.
mkdir there
(cd there && "$BULLA" run ../tube.yaml -o here --until '20 ms' --quiet >said 2>&1 && [ ! -s said ] && [ -s here/history.csv ])
awk -F, 'END { exit $2 != 0.02 }' there/here/history.csv
