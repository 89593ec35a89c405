# Checkpoints by wall time, which every case asks for: the time that passes is that of BULLA_STEP_SECONDS, so no clock
# decides. They do not change a number, a killed run goes on from them, a short run writes none, and one that cannot be
# written is a warning.
set -eu
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" # Open MPI leaks by itself
cat >tube.yaml <<'END'
bulla: 1
title: A tube
domain: {lower: [0], upper: [1], cells: [256], boundaries: {x-: outflow, x+: reflecting}}
mesh: {tile: 64}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: 1 bar}
  - {half-space: {point: [0.5], normal: [1]}, material: air, density: 0.125, pressure: 0.1 bar}
run: {until: 1, max-steps: 10}
output: {history: {columns: {m: {total: mass}, p: {max: pressure}}}}
END
wrong() { echo "$*"; ls -R; exit 1; }
list() { ls "$1/checkpoints" 2>/dev/null | tr '\n' ' '; }
slow() { # TIME ARGS...: a run whose steps each count as so many
    seconds=$1
    shift
    BULLA_STEP_SECONDS=$seconds "$BULLA" run "$@" --quiet
}
"$BULLA" run tube.yaml -o short --quiet
[ ! -e short/checkpoints ] || wrong 'a short run writes checkpoints'
slow 179 tube.yaml -o out
[ ! -e out/checkpoints ] || wrong 'a run of half an hour less ten seconds writes checkpoints'
rm -rf out

# 700 s a step: the third step ends the first half hour, the sixth and the ninth the next ones. The newest two stay.
for ranks in 1 2; do
    slow 700 tube.yaml -o out -n $ranks
    [ "$(list out)" = 'tube_000006.chk tube_000009.chk ' ] || wrong "$ranks ranks: $(list out)"
    cmp short/history.csv out/history.csv
    # What is killed after step 9 goes on from there, to the same end.
    "$BULLA" run tube.yaml -o out --quiet --restart
    cmp short/history.csv out/history.csv
    rm -rf out
done
slow 700 tube.yaml -o out --set 'output.checkpoints.wall=20 min' --set output.checkpoints.keep=9
[ "$(list out)" = 'tube_000002.chk tube_000004.chk tube_000006.chk tube_000008.chk ' ] || wrong "20 min: $(list out)"
rm -rf out
slow 700 tube.yaml -o out --set output.checkpoints.wall=0
[ ! -e out/checkpoints ] || wrong 'wall: 0 writes checkpoints'
rm -rf out

# Any checkpoint starts the half hour again, that of a number of steps too; and the end of the run leaves one then.
slow 700 tube.yaml -o out --set 'output.checkpoints={every: 4 steps, keep: 9}'
[ "$(list out)" = 'tube_000003.chk tube_000004.chk tube_000006.chk tube_000008.chk tube_000010.chk ' ] || wrong "every: $(list out)"
rm -rf out

# No place for it: a warning each time, and the run goes on to its end; if the case asks for one it is an error as before.
for ranks in 1 2; do
    mkdir out
    echo mine >out/checkpoints
    slow 700 tube.yaml -o out -n $ranks 2>said
    [ "$(grep -c 'warning: .*out/checkpoints: cannot make this folder.*; the run goes on without it' said)" = 3 ] || { cat said; exit 1; }
    cmp short/history.csv out/history.csv
    [ -s out/fields/tube_000010.hdf ] && [ "$(cat out/checkpoints)" = mine ]
    rm -rf out
done
mkdir out
echo mine >out/checkpoints
code=0
slow 700 tube.yaml -o out --set 'output.checkpoints={every: 4 steps}' 2>said || code=$?
[ "$code" = 3 ] || { echo "exit code $code"; cat said; exit 1; }
rm -rf out

# A limit on the size of files: the checkpoint (200 kB) does not fit, all else does. What was there stays, no draft is left.
cat >wide.yaml <<'END'
extends: tube.yaml
domain: {cells: [4096]}
materials: {water: {eos: {type: stiffened-gas, preset: sg44}}}
initial: [{everywhere: true, fractions: {air: 0.5, water: 0.5}, density: {air: 1, water: 1000}, pressure: 1 bar}]
output: {snapshots: {every: 1, fields: [pressure]}}
END
BULLA_STEP_SECONDS=700 sh -c "ulimit -f 180; exec '$BULLA' run wide.yaml -o out --quiet" 2>said || { cat said; ls -lR out; exit 1; }
grep -q 'warning: .*wide_000003.chk.*File too large.*; the run goes on without it' said || { cat said; ls -lR out; exit 1; }
[ -z "$(list out)" ] || wrong "a draft is left: $(list out)"

# --walltime reads the same clock.
code=0
slow 700 tube.yaml -o out --overwrite --walltime 40:00 2>said || code=$?
[ "$code" = 4 ] && [ "$(list out)" = 'tube_000003.chk tube_000004.chk ' ] || wrong "walltime: $code, $(list out)"
