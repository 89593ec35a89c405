# Checkpoints that cannot be gone on from: cut, with flipped bits anywhere, of another case, not checkpoints at all. Each
# is refused with one line that names the file and says what is wrong, exit code 2, on one rank and on several, and
# nothing is written. A damaged newest one is passed over with a warning.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cp "$BULLA_SOURCE/tests/data/cli/tube.yaml" .
levels='mesh={tile: 16, levels: 1, refine: [{jump: density, above: 0.02}]}'
"$BULLA" run tube.yaml -o out --quiet --max-steps 30 --set 'output.checkpoints={every: 10 steps, keep: 3}' --set "$levels"
good=out/checkpoints/tube_000030.chk
size=$(wc -c <$good)
sum=$(cksum out/*.csv out/fields/* out/checkpoints/*)

refused() { # PATTERN OPTIONS...: one line of errors with the pattern; nothing has changed
    pattern=$1
    shift
    code=0
    "$BULLA" run tube.yaml -o out --set "$levels" "$@" >said 2>&1 || code=$?
    [ "$code" = 2 ] || { echo "exit code $code, not 2: $*"; cat said; exit 1; }
    [ "$(wc -l <said)" = 1 ] && grep -q "^error: .*$pattern" said || { echo "not one line with '$pattern': $*"; cat said; exit 1; }
    [ "$(cksum out/*.csv out/fields/* out/checkpoints/*)" = "$sum" ] || { echo "something was changed: $*"; exit 1; }
}
flip() { # FILE OFFSET: the lowest bit of a byte
    byte=$(od -An -tu1 -j"$2" -N1 "$1" | tr -d ' ')
    # shellcheck disable=SC2059
    printf "\\$(printf %o $((byte ^ 1)))" | dd of="$1" bs=1 seek="$2" conv=notrunc 2>/dev/null
}

for length in 0 1 15 16 100 4095 4096 5000 $((size - 1)); do
    head -c "$length" $good >cut.chk
    refused "cannot restart: cut.chk: .*cut" --restart cut.chk
done
cp $good longer.chk
echo >>longer.chk
refused "longer.chk: damaged: $((size + 1)) bytes long, not $size" --restart longer.chk -n 2
offsets="0 17 40 60 4095 4096"
for _ in 1 2 3 4; do
    draw "$size"
    offsets="$offsets $drawn"
done
for offset in $offsets; do
    cp $good flipped.chk
    flip flipped.chk "$offset"
    refused "cannot restart: flipped.chk: \(damaged\|not a checkpoint\)" --restart flipped.chk || { echo "byte $offset"; exit 1; }
    "$BULLA" info flipped.chk >said 2>&1 && { echo "info believes a flipped bit at $offset"; exit 1; }
done
refused "flipped.chk: " --restart flipped.chk -n 3
refused "nowhere.chk: .*No such file" --restart nowhere.chk
refused "tube.yaml: not a checkpoint of bulla" --restart=tube.yaml
refused "out: not a file" --restart=out
refused "out/fields/tube_.*not a checkpoint" --restart "$(ls out/fields/*.hdf | tail -n 1)"

# Another case: what differs is said. What does not matter is not asked for.
refused "$good: cannot restart: .*domain.cells is '64' there and '128' here" --restart --set 'domain.cells=[128]'
refused "domain.upper is '1' there and '2' here" --restart --set 'domain.upper=[2]'
refused "mesh.tile is" --restart --set mesh.tile=8 -n 2
refused "materials.air.eos is 'ideal-gas gamma=1.4 .*' there and 'ideal-gas gamma=1.3" --restart --set materials.air.eos.gamma=1.3
refused "its mesh takes .* GiB, and may take .* GiB" --restart --max-memory 5kB
refused "goes on with the run in out, which --overwrite would remove" --restart --overwrite
refused "holds a run: " # as without checkpoints

# Damaged ones are passed over.
flip $good 5000
flip out/checkpoints/tube_000020.chk 20
"$BULLA" run tube.yaml -o out --set "$levels" --restart --max-steps 12 >said 2>&1
[ "$(grep -c 'warning: passed over: out/checkpoints/tube_0000[23]0.chk: damaged' said)" = 2 ] || { cat said; exit 1; }
grep -q 'going on from out/checkpoints/tube_000010.chk: .*step 10' said
[ "$(tail -n 1 out/history.csv | cut -d, -f1)" = 12 ]
for file in out/checkpoints/*.chk; do flip "$file" 9999; done
sum=$(cksum out/*.csv out/fields/* out/checkpoints/*)
code=0
"$BULLA" run tube.yaml -o out --set "$levels" --restart >said 2>&1 || code=$?
[ "$code" = 2 ] && grep -q '^error: cannot restart: no checkpoint in out/checkpoints is whole' said || { cat said; exit 1; }
[ "$(cksum out/*.csv out/fields/* out/checkpoints/*)" = "$sum" ]

# A later limit of levels is no other case, nor is none at all.
"$BULLA" run tube.yaml -o more --quiet --max-steps 10 --set "$levels"
"$BULLA" run tube.yaml -o more --quiet --max-steps 20 --restart --set 'mesh={tile: 16, levels: 2, refine: [{jump: density, above: 0.02}]}'
"$BULLA" info more/checkpoints/tube_000020.chk | grep -q '^level 2'
"$BULLA" run tube.yaml -o more --quiet --max-steps 30 --restart --set 'mesh={tile: 16}' -n 2
"$BULLA" info more/checkpoints/tube_000030.chk | grep -q '^level 1' && { echo "levels are left"; exit 1; }
exit 0
