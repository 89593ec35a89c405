# Every file call of a checkpoint fails once: full disk, broken disk, a short write, a bit that the disk loses, and the process
# is killed before it. The older checkpoint stays whole and the run goes on from one that is: to the bits of an
# undisturbed run. What the disk got wrong is found when the file is read back, not at the restart.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
same="$BULLA_BUILD/tests/test-unit-checkpoint"
export ASAN_OPTIONS="$ASAN_OPTIONS:verify_asan_link_order=0" # the preloaded library comes first
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
END
fault="$BULLA_BUILD/tests/fault/fault.so"
rm -rf whole base
"$BULLA" run tube.yaml -o whole --quiet
"$BULLA" run tube.yaml -o base --quiet --max-steps 2
go() { # WISH: from step 2 to the end, with a fault
    rm -rf out
    cp -r base out
    code=0
    BULLA_FAULT="$1" BULLA_FAULT_COUNT=$PWD/count LD_PRELOAD="$fault" "$BULLA" run tube.yaml -o out --quiet --restart \
        >said 2>&1 || code=$?
}
wrong() { echo "$1 ($wish, exit code $code):"; cat said; ls out/checkpoints; exit 1; }
go "0 none"
calls=$(cat count)
[ "$calls" -ge 20 ] || { echo "only $calls calls were seen"; exit 1; }

call=1
while [ "$call" -le "$calls" ]; do
    for what in kill enospc eio short flip; do
        # kill at each call, the others in turn: a fifth of all pairs
        [ $what = kill ] || [ $((call % 4)) = "$(echo $what | sed 's/enospc/0/; s/eio/1/; s/short/2/; s/flip/3/')" ] || continue
        wish="$call $what"
        go "$wish"
        [ -z "${BULLA_SHOW:-}" ] || echo "$wish: $code $(head -n 1 said)"
        case $what-$code in
        kill-137 | *-0 | enospc-3 | eio-3 | short-3 | flip-3) ;;
        *) wrong "unexpected" ;;
        esac
        [ "$code" != 3 ] || grep -q '^error: .*checkpoint' said || wrong "no reason is given"
        [ "$code" = 137 ] || [ -z "$(ls out/checkpoints | grep tmp)" ] || wrong "a draft is left"
        for file in out/checkpoints/*.chk; do "$BULLA" info "$file" >/dev/null 2>&1 || wrong "$file is damaged"; done
        [ "$code" = 0 ] || "$BULLA" run tube.yaml -o out --quiet --restart >said 2>&1 || wrong "it does not go on"
        cmp whole/history.csv out/history.csv || wrong "other rows"
        "$same" whole/checkpoints/tube_000006.chk out/checkpoints/tube_000006.chk || wrong "other fields"
        [ "$(ls out/checkpoints)" = tube_000006.chk ] || wrong "other files"
    done
    call=$((call + 1))
done
