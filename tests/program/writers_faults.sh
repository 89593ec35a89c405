# Every other file call of a writer that is not rank 0 fails once while checkpoints are written: full disk, broken disk, a short
# write, a bit that is lost, or the rank is killed before it. All ranks end with exit code 3 and one reason, the older
# checkpoint and its parts stay whole, no draft is left, and the run goes on from it to the bits of an undisturbed one.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
same="$BULLA_BUILD/tests/test-unit-checkpoint"
export ASAN_OPTIONS="$ASAN_OPTIONS:verify_asan_link_order=0" # the preloaded library comes first
mpirun --version 2>/dev/null | grep -q 'Open MPI' || { echo "skipped: ranks are told by Open MPI"; exit 77; }
cat >tube.yaml <<'END'
bulla: 1
title: A tube
domain: {lower: [0], upper: [1], cells: [64], boundaries: {x-: outflow, x+: reflecting}}
mesh: {tile: 16}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: 1 bar}
  - {half-space: {point: [0.5], normal: [1]}, material: air, density: 0.125, pressure: 0.1 bar}
run: {until: 1, max-steps: 6}
output:
  checkpoints: {every: 2 steps, keep: 1}
  history: {columns: {m: {total: mass}}}
  writers: 2
END
fault="$BULLA_BUILD/tests/fault/fault.so"
"$BULLA" run tube.yaml -o whole --quiet
"$BULLA" run tube.yaml -o base --quiet --max-steps 2 -n 2
go() { # WISH: from step 2 to the end, with a fault of the second writer
    rm -rf out
    cp -r base out
    complete env BULLA_FAULT="$1" BULLA_FAULT_RANK=1 BULLA_FAULT_COUNT="$PWD/count" LD_PRELOAD="$fault" \
        "$BULLA" run tube.yaml -o out --quiet --restart -n 2 >said 2>&1
}
wrong() { echo "$1 ($wish, exit code $code):"; cat said; ls out/checkpoints; exit 1; }
wish=none
go "0 none"
[ "$code" = 0 ] || wrong "it fails without a fault"
calls=$(cat count)
[ "$calls" -ge 15 ] || { echo "only $calls calls were seen"; exit 1; }

call=1
while [ "$call" -le "$calls" ]; do
    # one kind of fault per call; what a disk loses shows when it is read back
    for what in $(echo "kill enospc eio short flip" | tr ' ' '\n' | sed -n "$((call / 2 % 5 + 1))p"); do
        wish="$call $what"
        go "$wish"
        [ -z "${BULLA_SHOW:-}" ] || echo "$wish: $code $(head -n 1 said)"
        case $what-$code in
        kill-* | *-0 | enospc-3 | eio-3 | short-3 | flip-3) ;;
        *) wrong "unexpected" ;;
        esac
        [ "$code" != 3 ] || [ $what = kill ] || [ "$(grep -c '^error: no checkpoint\|^error: the last' said)" -ge 1 ] || wrong "not one reason"
        [ $what = kill ] || ! ls out/checkpoints | grep -q tmp || wrong "a draft is left"
        for file in out/checkpoints/*.chk; do "$BULLA" info "$file" >/dev/null 2>&1 || wrong "$file is damaged"; done
        [ "$code" = 0 ] || "$BULLA" run tube.yaml -o out --quiet --restart -n 2 >said 2>&1 || wrong "it does not go on"
        cmp whole/history.csv out/history.csv || wrong "other rows"
        "$same" whole/checkpoints/tube_000006.chk out/checkpoints/tube_000006.chk || wrong "other fields"
        [ "$(ls out/checkpoints | grep -c 'tube_000006.chk$')" = 1 ] || wrong "no file of step 6"
        [ "$(ls out/checkpoints | grep -c 'tube_000006.chk.[ab][12]$')" = 2 ] || wrong "not two parts"
    done
    call=$((call + 2))
done
