# Several writers: what they write together is, number by number, what one writes, on any ranks; a run goes on from the
# checkpoint of any writers with any others; `bulla join` makes the one file of it. Lost, cut, damaged parts and those of
# another file are told from each other, in one line, and nothing is believed or changed.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
same="$BULLA_BUILD/tests/test-unit-checkpoint"
cat >three.yaml <<'END'
bulla: 1
title: A wave meets a bubble
domain:
  geometry: axisymmetric
  lower: [0, -1 mm]
  upper: [1 mm, 1 mm]
  cells: [24, 48]
  boundaries: {x-: axis, x+: outflow, y-: reflecting, y+: outflow}
mesh: {tile: 8, levels: 2, regrid-every: 2, buffer: 3, refine: [{interface: air}]}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1 bar}
  - {half-space: {point: [0, 0.7 mm], normal: [0, 1]}, material: water, density: 1010, pressure: 300 bar}
  - {sphere: {center: [0, 0], radius: 0.5 mm}, material: air, density: 1.2, pressure: 1 bar}
run: {until: 1 us, max-steps: 12}
output:
  snapshots: {every: 6 steps, fields: [density, velocity, max_pressure, alpha_air]}
  checkpoints: {every: 6 steps, keep: 2}
  history: {columns: {V: {volume: air}}}
  writers: 3
END
sed 's/writers: 3/writers: 2/' three.yaml >two.yaml
count() { find "$1" -name "$2" | wc -l; } # FOLDER PATTERN

# As many writers as there are ranks, if more are wanted: on one rank there are no parts.
ranked three 1 3
ran three-2 three -n 2
alike three-1 three-2
ranked two 1 3
[ "$(count three-1 '*.a*')" = 0 ] || fail "parts of one writer"
[ "$(count two-3/out/checkpoints 'two_0000??.chk')$(count two-3/out/checkpoints 'two_0000??.chk.a[12]')" = 24 ] ||
    fail "not two checkpoints of two parts"
[ "$(count three-3/out/fields 'three_0000??.hdf.a[123]')" = 9 ] || fail "not 9 parts of 3 snapshots"
for folder in three-2 three-3; do "$same" three-1/out/checkpoints/three_000012.chk $folder/out/checkpoints/three_000012.chk; done
"$same" two-1/out/checkpoints/two_000012.chk two-3/out/checkpoints/two_000012.chk

# On from any set with any other.
rm -rf part
for numbers in "3 3 1 1" "1 1 3 3" "3 2 2 2" "2 2 3 3"; do
    # shellcheck disable=SC2086
    set -- $numbers
    ran part three --overwrite -n "$1" --writers "$2" --max-steps 7
    ran part three --restart -n "$3" --writers "$4"
    cmp three-1/out/history.csv part/out/history.csv
    "$same" three-1/out/checkpoints/three_000012.chk part/out/checkpoints/three_000012.chk
    parts=$4
    [ "$parts" -gt 1 ] || parts=0
    [ "$(count part/out/checkpoints '*_000012.chk.a*')" = $parts ] || fail "not $parts parts"
done
# The same step once more: the old file is whole until the new one is.
ran part three --restart out/checkpoints/three_000007.chk -n 3 --writers 3
[ "$(count part/out/checkpoints '*_000012.chk.b[123]')" = 3 ] || fail "no parts b: $(ls part/out/checkpoints)"
[ "$(count part/out/checkpoints '*_000012.chk.[a-z]*')" = 3 ] || fail "parts of the old file are left"
"$same" three-1/out/checkpoints/three_000012.chk part/out/checkpoints/three_000012.chk

# What is wrong with parts: `info` and a restart say it with exit code 2, `join` with 3.
says() { # CODE PATTERN COMMAND...: one line
    says_code=$1 says_pattern=$2
    shift 2
    code=0
    "$@" >said 2>err || code=$?
    [ "$code" = "$says_code" ] || fail "exit code $code: $*" err
    [ "$(wc -l <err)" = 1 ] && grep -q "^error: $says_pattern" err || fail "not one line with '$says_pattern': $*" err
}
broken() { # PATTERN FILE: all that open it say so
    says 2 "$2: part 2 of 3.*$1" "$BULLA" info "$2"
    says 3 "$2: part 2 of 3.*$1" "$BULLA" join "$2"
    case $2 in
    *.chk)
        says 2 "cannot restart: $2: part 2 of 3.*$1" "$BULLA" run three.yaml -o elsewhere --restart "$2"
        ;;
    esac
}
for file in fields/three_000012.hdf checkpoints/three_000012.chk; do
    good=three-3/out/$file
    cp "$good.a2" kept
    rm "$good.a2"
    broken 'is lost: there is no three_000012.*.a2' "$good"
    case $file in *.chk) says 2 'cannot restart: .* is lost' "$BULLA" run three.yaml -o no --restart "$good" -n 2 ;; esac
    head -c 5000 kept >"$good.a2"
    broken 'it was cut' "$good"
    cp "$good.a1" "$good.a2"
    broken 'is whole, but of another run or moment' "$good"
    { head -c 4096 /dev/zero && tail -c +4097 kept; } >"$good.a2"
    broken 'was not finished' "$good"
    cp kept "$good.a2"
    byte=$(od -An -tu1 -j20000 -N1 kept | tr -d ' ')
    # shellcheck disable=SC2059
    printf "\\$(printf %o $((byte ^ 1)))" | dd of="$good.a2" bs=1 seek=20000 conv=notrunc 2>/dev/null
    case $file in
    *.chk) broken 'damaged: the checksum' "$good" ;;
    *.hdf) says 3 "$good: part 2 of 3.*damaged: the checksum" "$BULLA" join "$good" ;; # others trust the disk
    esac
    cp kept "$good.a2"
    says 2 ".*a part of a snapshot or checkpoint" "$BULLA" info "$good.a2"
done
rm three-3/out/checkpoints/three_000012.chk.a1
(cd three-3 && "$BULLA" run three.yaml -o out --restart -n 2 >../said 2>&1) || fail "it does not go on" said
grep -q 'passed over: .*three_000012.chk: part 1 of 3 is lost' said || fail "not passed over" said
"$same" three-1/out/checkpoints/three_000012.chk three-3/out/checkpoints/three_000012.chk

# One file again: what one writer would have written, number by number; nothing else is touched.
"$BULLA" join two-3/out >said
[ "$(grep -c 'one file of 2 parts' said)" = 5 ] || fail "not 5 files" said
[ "$(count two-3/out '*.a[12]')$(count two-3/out '*.tmp')" = 00 ] || fail "something is left: $(ls two-3/out/*)"
alike two-1 two-3
"$same" two-1/out/checkpoints/two_000012.chk two-3/out/checkpoints/two_000012.chk
sum=$(cksum two-3/out/*/*)
"$BULLA" join two-3/out/fields two-3/out/checkpoints/two_000006.chk >said
grep -q 'it has no parts' said || fail "not said" said
[ "$(cksum two-3/out/*/*)" = "$sum" ] || fail "joined files were changed"
ran two-3 two --restart --max-steps 13

code=0
"$BULLA" check three.yaml --set output.writers=0 >said 2>&1 || code=$?
[ "$code" = 2 ] && grep -q 'output.writers: 0 is outside 1 to' said || fail "no writers are accepted" said
/usr/bin/python3 -c 'import numpy, h5py' 2>/dev/null || exit 0
cat >look.py <<'END'
import os
import sys

sys.path.insert(0, sys.argv[1])
import bulla
import numpy as np

a, b = (bulla.Run(name)[-1] for name in ("three-1/out", "three-2/out"))
assert np.array_equal(a["density"], b["density"]) and np.array_equal(a.lower, b.lower)
for change, wanted in ((lambda name: os.rename(name, "away"), "is lost"), (lambda name: open(name, "wb"), "is broken")):
    change(b.path + ".a2")
    try:
        bulla.Snapshot(b.path)
        sys.exit("not noticed: " + wanted)
    except (FileNotFoundError, ValueError) as error:
        assert wanted in str(error), error
END
/usr/bin/python3 look.py "$BULLA_SOURCE/packaging/python"
