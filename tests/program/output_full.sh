# A full disk while a snapshot is written, of the only writer or of one of three: the run ends on all ranks with exit code 3 and
# one reason, what was written before stays readable, and provenance says why.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
[ -w /dev/full ] || { echo "skipped: no /dev/full"; exit 77; }
cat >tube.yaml <<'END'
bulla: 1
title: A tube
domain: {lower: [0], upper: [1], cells: [4096], boundaries: {x-: outflow, x+: outflow}}
mesh: {tile: 64}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: 1 bar}
  - {half-space: {point: [0.5], normal: [1]}, material: air, density: 0.125, pressure: 0.1 bar}
run: {until: 1 s}
output:
  snapshots: {every: 1000 steps}
END
begun() { [ -e out/fields/tube_000000.hdf ] || ! alive "$run"; }
for ranks in 1 3 '3 --writers 3'; do
    rm -rf out
    draft=tmp
    [ ${#ranks} = 1 ] || draft=a2.tmp
    # shellcheck disable=SC2086
    start "$BULLA" run tube.yaml -o out -n $ranks --quiet 2>errors.txt
    await "the first snapshot" begun
    # shellcheck disable=SC2046
    kill -s STOP $(members "$run")
    number=1000 # from now on the disk is full: one of these is the next file, after one that may be under way
    while [ "$number" -le 40000 ]; do
        file=out/fields/$(printf 'tube_%06d.hdf' "$number")
        [ -e "$file" ] || ls "$file".* >/dev/null 2>&1 || ln -s /dev/full "$file.$draft"
        number=$((number + 1000))
    done
    # shellcheck disable=SC2046
    kill -s CONT $(members "$run")
    ended "$run"
    [ "$code" -eq 3 ] || fail "exit code $code on $ranks ranks, not 3" errors.txt
    grep -q "tube_[0-9]*.hdf.$draft: cannot .*No space left on device" errors.txt || fail "not said" errors.txt
    [ "$(grep -c '^error.*No space' errors.txt)" = 1 ] || fail "more than one reason" errors.txt
    grep -q '"exit_reason": ".*No space left on device' out/provenance.json
    grep -q '"exit_code": 3' out/provenance.json
    "$BULLA" info out/fields/tube_000000.hdf >/dev/null
done
