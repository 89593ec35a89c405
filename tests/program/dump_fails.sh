# A failed step whose dump cannot be written: the reason, once, beside the reason of the failure; the last good state is
# saved all the same, provenance says why the run ended, no draft is left, and the exit code is 3, on any number of ranks.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cat >torn.yaml <<'CASE'
bulla: 1
title: Water torn apart, in steps that are far too long
domain: {lower: [-1], upper: [1], cells: [128], boundaries: {x-: periodic, x+: periodic}}
mesh: {tile: 16}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: ['= x > 0 and 500 or -500']}
scheme: {limiter: mc, dt: 1 ms}
run: {until: 1}
CASE

fails() { # RANKS WORDS
    code=0
    "$BULLA" run torn.yaml --quiet -o out -n "$1" >said 2>&1 || code=$?
    [ "$code" = 3 ] || { echo "exit code $code, not 3"; cat said; exit 1; }
    [ "$(grep -c 'could not be dumped' said)" = 1 ] || { echo "not said once"; cat said; exit 1; }
    grep -q "could not be dumped: out/dump_000001.h5.*$2" said || { echo "no '$2'"; cat said; exit 1; }
    grep -q 'step 1 at t = 0 s cannot be completed' said || { cat said; exit 1; }
    grep -q 'saved as out/checkpoints/torn_000000.chk' said || { cat said; exit 1; }
    "$BULLA" info out/checkpoints/torn_000000.chk >/dev/null
    grep -q '"exit_code": 3' out/provenance.json
    grep -q '"exit_reason": "step 1 at t = 0 s cannot be completed' out/provenance.json
    ! find out -name '*.tmp' | grep . || { echo "a draft is left"; exit 1; }
    rm -rf out
}

# Nothing in the way: there is one, and it can be computed again.
"$BULLA" run torn.yaml --quiet -o out >said 2>&1 && { echo "it did not fail"; exit 1; }
"$BULLA" info --replay out/dump_000001.h5 >/dev/null
rm -rf out

for ranks in 1 2; do
    mkdir -p out/dump_000001.h5/taken # the name is taken by a folder
    fails $ranks 'Is a directory'
    mkdir -p out/dump_000001.h5.tmp/taken # so is that of the draft
    code=0
    "$BULLA" run torn.yaml --quiet -o out -n "$ranks" >said 2>&1 || code=$?
    [ "$code" = 3 ] || { echo "exit code $code, not 3"; cat said; exit 1; }
    grep -q 'could not be dumped: out/dump_000001.h5.tmp: cannot create it: Is a directory' said || { cat said; exit 1; }
    rm -rf out
    [ -w /dev/full ] || continue
    mkdir out
    ln -s /dev/full out/dump_000001.h5.tmp # the disk is full
    fails $ranks 'No space left on device; .* free in out'
done

# A disk of its own, where it may be mounted, with too little room for dump, checkpoint and snapshot (30 kB each).
mkdir disk
mount -t tmpfs -o size=1m none disk 2>/dev/null || { echo "no disk of its own: that part is skipped"; exit 0; }
trap 'umount disk' EXIT
for room in 80000 50000 30000 10000; do
    head -c "$((1048576 - room))" /dev/zero >disk/other
    code=0
    "$BULLA" run torn.yaml --quiet -o disk/out -n 2 >said 2>&1 || code=$?
    [ "$code" = 3 ] || { echo "exit code $code, not 3"; cat said; exit 1; }
    grep -q 'No space left on device; .* free in disk' said || { cat said; exit 1; }
    ! find disk -name '*.tmp' | grep . || { echo "a draft is left"; exit 1; }
    rm -rf disk/*
done
