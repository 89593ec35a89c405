# No room for a checkpoint: a full disk, a limit on the size of files, a folder that cannot be made. The run ends on all
# ranks with exit code 3 and the reason, the older checkpoint is intact, no draft is left, and with room again the run
# goes on to the bits of an undisturbed one.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
same="$BULLA_BUILD/tests/test-unit-checkpoint"
cat >tube.yaml <<'END'
bulla: 1
title: A tube
domain: {lower: [0], upper: [1], cells: [4096], boundaries: {x-: outflow, x+: reflecting}}
mesh: {tile: 64}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: 1 bar}
  - {half-space: {point: [0.5], normal: [1]}, material: air, density: 0.125, pressure: 0.1 bar}
run: {until: 1, max-steps: 40}
output:
  checkpoints: {every: 10 steps, keep: 2}
  history: {columns: {m: {total: mass}}}
END
rm -rf whole disk out
"$BULLA" run tube.yaml -o whole --quiet

failed() { # PATTERN COMMAND...: exit code 3 and the reason
    pattern=$1
    shift
    complete "$@" >said 2>&1
    [ "$code" = 3 ] || { echo "exit code $code, not 3: $*"; cat said; exit 1; }
    grep -q "error: .*$pattern" said || { echo "no '$pattern':"; cat said; exit 1; }
}
intact() { # FOLDER: two whole checkpoints, of steps 10 and 20, no draft, no part of another
    [ "$(ls "$1/checkpoints" | sed 's/\.a[123]$//' | uniq)" = "$(printf 'tube_000010.chk\ntube_000020.chk')" ] ||
        { ls -l "$1/checkpoints"; exit 1; }
    for file in "$1"/checkpoints/*.chk; do "$BULLA" info "$file" >/dev/null; done
}
go_on() { # FOLDER
    "$BULLA" run tube.yaml -o "$1" --quiet --restart
    cmp whole/history.csv "$1/history.csv"
    "$same" whole/checkpoints/tube_000040.chk "$1/checkpoints/tube_000040.chk"
    rm -rf "$1"
}

# A limit on the size of files: the next checkpoint (about 100 kB) does not fit. Not through mpirun, which needs files.
"$BULLA" run tube.yaml -o out --quiet --max-steps 20
failed 'tube_0000[0-9]*.chk.*File too large' sh -c "ulimit -f 100; exec '$BULLA' run tube.yaml -o out --restart"
intact out
go_on out

# The folder is taken by a file.
mkdir out
echo mine >out/checkpoints
failed 'out/checkpoints: cannot make this folder' "$BULLA" run tube.yaml -o out
[ "$(cat out/checkpoints)" = mine ]
rm -rf out

# A disk of its own, where it may be mounted: half a checkpoint fits.
mkdir disk
mount -t tmpfs -o size=2m none disk 2>/dev/null || { echo "no disk of its own: that part is skipped"; exit 0; }
at_end='umount disk'
for ranks in 1 3 '3 --writers 3'; do
    # shellcheck disable=SC2086
    "$BULLA" run tube.yaml -o disk/out --quiet --max-steps 20 -n $ranks
    rm -rf disk/out/fields # the last state, which goes when the run goes on
    head -c "$(($(df --output=avail -B1 disk | tail -n 1) - 50000))" /dev/zero >disk/other
    # shellcheck disable=SC2086
    failed 'No space left on device' "$BULLA" run tube.yaml -o disk/out --restart -n $ranks
    [ "$(grep -c '^error: no checkpoint' said)" = 1 ] || { echo "more than one reason:"; cat said; exit 1; }
    grep -q 'tube_0000[0-9]*.chk.*; .* MB are free in disk/out/checkpoints' said || { cat said; exit 1; }
    intact disk/out
    rm disk/other
    go_on disk/out
done
