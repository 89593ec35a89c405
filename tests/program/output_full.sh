# A full disk while a snapshot is written: the run ends on all ranks with exit code 3 and one reason, what was
# written before stays readable, and provenance says why.
set -eu
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
for ranks in 1 3; do
    rm -rf out
    ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" \
        "$BULLA" run tube.yaml -o out -n "$ranks" --quiet 2>errors.txt &
    run=$!
    until [ -e out/fields/tube_000000.hdf ]; do
        kill -0 "$run" || { echo "the run ended by itself"; exit 1; }
    done
    number=1000 # from now on the disk is full: one of these is the next file, a good while away
    while [ "$number" -le 40000 ]; do
        ln -sf /dev/full "out/fields/$(printf 'tube_%06d.hdf.tmp' "$number")" 2>/dev/null || true
        number=$((number + 1000))
    done
    code=0
    wait "$run" || code=$?
    [ "$code" -eq 3 ] || { echo "exit code $code on $ranks ranks, not 3"; cat errors.txt; exit 1; }
    grep -q 'tube_[0-9]*.hdf.tmp: cannot .*No space left on device' errors.txt || { cat errors.txt; exit 1; }
    grep -q '"exit_reason": ".*No space left on device' out/provenance.json
    grep -q '"exit_code": 3' out/provenance.json
    "$BULLA" info out/fields/tube_000000.hdf >/dev/null
done
