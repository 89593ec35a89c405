# Signals and the wall clock: the step is finished, a checkpoint written, exit code 4, and the command that the run
# prints goes on to the same bits as a run that nobody stopped. A second signal stops at once. A file called
# output_now asks for a snapshot. A failed run leaves a checkpoint of its last good state.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
same="$BULLA_BUILD/tests/test-unit-checkpoint"
cat >tube.yaml <<'END'
bulla: 1
title: A tube
domain: {lower: [0], upper: [1], cells: [256], boundaries: {x-: outflow, x+: reflecting}}
mesh: {tile: 64}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: 1 bar}
  - {half-space: {point: [0.5], normal: [1]}, material: air, density: 0.125, pressure: 0.1 bar}
run: {until: 1e3, max-steps: 12000}
output:
  snapshots: {every: 1000 steps}
  history: {every: 70 steps, columns: {m: {total: mass}}}
  probes: {every: 1 ms, wall: {at: [0.9], fields: [pressure]}}
END
rm -rf whole first
"$BULLA" run tube.yaml -o whole --quiet --set output.checkpoints.every=12000steps

begun() { [ "$(cat first/history.csv 2>/dev/null | wc -l)" -gt 12 ] || ! alive "$run"; }
begin() { # OPTIONS...: until the run has written some rows, or is over
    rm -rf first
    start "$BULLA" run tube.yaml -o first "$@" >said 2>&1
    await "the first rows" begun
}
stopped() { # WHAT: exit code 4, and a message that names what stopped it; false: too late, the run had finished
    ended "$run"
    [ "$code" != 0 ] || return 1
    [ "$code" = 4 ] || fail "$1: exit code $code, not 4" said
    grep -q "interrupted.*$1.*saved as first/checkpoints/tube_[0-9]*.chk; to go on: bulla run" said || fail "$1 is not said" said
}
interrupt() { # SIGNAL OPTIONS...
    signal=$1
    shift
    begin "$@"
    kill -s "$signal" "$run" 2>/dev/null || true
    stopped "SIG$signal"
}
go_on() { # with the command that was printed
    sed -n "s/.*to go on: bulla/\"\$BULLA\"/p" said >command
    . ./command >said 2>&1 || fail "going on failed" command said
}
finished() {
    for file in history.csv probes.csv fields/tube.hdf.series; do cmp whole/$file first/$file; done
    [ "$(ls whole/fields)" = "$(ls first/fields)" ] || fail "other snapshots"
    # the whole run ends with a checkpoint because its case asks for them
    "$BULLA" run tube.yaml -o first --quiet --restart --set output.checkpoints.every=12000steps
    "$same" whole/checkpoints/tube_012000.chk first/checkpoints/tube_012000.chk
    rm -rf first
}

for signal in INT TERM USR1; do
    insist interrupt $signal
    [ $signal = TERM ] || continue # one of them goes on
    go_on
    finished
done

# Through mpirun, where the parent passes the signal on.
insist interrupt INT -n 2
go_on
finished

# Before the first step, too.
start "$BULLA" run tube.yaml -o first --walltime 0 >said 2>&1
stopped walltime || fail "it was not stopped" said
"$BULLA" run tube.yaml -o first --quiet --restart
finished

# Two signals that arrive together: the second ends the run.
twice() {
    begin
    for signal in STOP TERM INT CONT; do kill -s $signal "$run" 2>/dev/null || true; done
    ended "$run"
    [ "$code" != 0 ]
}
insist twice
[ "$code" = 4 ] && grep -q 'stopped at once' said || fail "exit code $code after two signals" said
[ ! -e first/checkpoints ] || fail "saved after a second signal"

# A snapshot on request; the run and its bits are not disturbed.
answered() { [ ! -e first/output_now ] || ! alive "$run"; }
request() {
    begin --set output.snapshots.every=1e3 --set output.checkpoints.every=12000steps
    touch first/output_now
    await "an answer" answered
    ended "$run"
    [ "$code" = 0 ] || fail "exit code $code" said
    [ ! -e first/output_now ]
}
insist request
asked=$(sed -n 's/.*a snapshot of step \([0-9]*\), as .*output_now asked.*/\1/p' said)
"$BULLA" info "first/fields/tube_$(printf %06d "$asked").hdf" >/dev/null
cmp whole/history.csv first/history.csv
"$same" whole/checkpoints/tube_012000.chk first/checkpoints/tube_012000.chk

# A run that fails leaves a checkpoint of the last good state; with other settings it goes on from there.
sed 's/pressure: 1 bar}/pressure: 1 bar, velocity: [-18 km\/s]}/; s/pressure: 0.1 bar}/pressure: 0.1 bar, velocity: [18 km\/s]}/' \
    tube.yaml >torn.yaml
code=0
"$BULLA" run torn.yaml -o torn --set scheme.guard=strict >said 2>&1 || code=$?
[ "$code" = 3 ] || fail "exit code $code, not 3" said
step=$(sed -n 's/.*error: step \([0-9]*\) at t.*/\1/p' said)
[ -e "torn/checkpoints/torn_$(printf %06d $((step - 1))).chk" ] || { cat said; ls torn/checkpoints; exit 1; }
"$BULLA" run torn.yaml -o torn --restart --set scheme.guard=normal --max-steps $((step + 20)) >said 2>&1 || { cat said; exit 1; }
[ "$(tail -n 1 torn/history.csv | cut -d, -f1)" = $((step + 20)) ]

# A finer level that fails half way leaves no state of one time: the newest checkpoint is named, and the run goes on there.
sed 's/^mesh:.*/mesh: {tile: 16, levels: 1, refine: [{region: {everywhere: true}}]}/' torn.yaml >deep.yaml
code=0
"$BULLA" run deep.yaml -o deep --set scheme.guard=strict --set output.checkpoints.every=2steps >said 2>&1 || code=$?
[ "$code" = 3 ] || fail "exit code $code, not 3" said
left=$(sed -n 's/^error: a finer level failed half way through step .*; the newest checkpoint is //p' said)
[ "$left" = "$(ls deep/checkpoints/*.chk | tail -n 1)" ] || { cat said; ls deep/checkpoints; exit 1; }
"$BULLA" run deep.yaml -o deep --restart --quiet --max-steps 20
[ "$(tail -n 1 deep/history.csv | cut -d, -f1)" = 20 ]
