# verify: lists scenes, runs one at several resolutions, judges bounds and orders, saves tables between markers.
set -eu
cat >tube.yaml <<'END'
bulla: 1
title: Small tube
domain: {lower: [0], upper: [1], cells: [64], boundaries: {x-: outflow, x+: outflow}}
materials: {gas: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: gas, density: 0.125, pressure: 0.1}
  - {half-space: {normal: [-1], point: [0.5]}, material: gas, density: 1, pressure: 1}
run: {until: 0.2}
output: {directory: out/tube, snapshots: {every: 0.2, fields: [density, pressure], precision: double}}
expect:
  - {norm: L1, field: density, reference: exact-riemann, at-most: 0.02, order: 0.5}
matrix: {domain.cells: [[32], [64], [128]]}
END
expect_code() { # CODE COMMAND...
    wanted=$1 got=0
    shift
    "$@" >stdout 2>stderr || got=$?
    [ "$got" = "$wanted" ] || { echo "exit code $got, wanted $wanted: $*"; cat stdout stderr; exit 1; }
}
"$BULLA" verify --list | grep -q '^r01 .*250, 500, 1000, 2000'
expect_code 2 "$BULLA" verify no-such-scene
grep -q 'no verification scene' stderr

expect_code 0 "$BULLA" verify tube.yaml
grep -q '^| 32 |.*| *$' stdout
grep -q '^| 128 |' stdout
grep -q 'L1(density) | order' stdout
grep -q 'Holds' stdout
orders=$(awk -F '|' '/^\| 128 /{print ($5 > 0.5 && $5 < 1.5)}' stdout)
[ "$orders" = 1 ] || { cat stdout; exit 1; }

# A bound that cannot hold, at the case's own resolution and finer alone; an order that cannot.
sed 's/at-most: 0.02/at-most: 1e-6/' tube.yaml >bound.yaml
expect_code 1 "$BULLA" verify bound.yaml
[ "$(grep -c 'fails' stdout)" = 2 ]
sed 's/order: 0.5/order: 3/' tube.yaml >order.yaml
expect_code 1 "$BULLA" verify order.yaml
grep -q 'Does not hold' stdout

# A run that fails is a row of the table, not the end of it.
sed 's/\[64\], \[128\]/[64], [0]/' tube.yaml >broken.yaml
expect_code 1 "$BULLA" verify broken.yaml
grep -q 'run failed (exit code 2)' stdout
grep -q '^| 64 |' stdout

# Only the text between the markers of a scene changes.
mkdir -p here/cases/verify here/docs
cp tube.yaml here/cases/verify/
cd here
printf 'Before.\n<!-- verify tube -->\nold\n<!-- end tube -->\nAfter.\n' >docs/verification.md
"$BULLA" verify tube --save >/dev/null 2>&1
grep -q '^Before' docs/verification.md
grep -q '^After' docs/verification.md
grep -q '^| 64 |' docs/verification.md
! grep -q '^old' docs/verification.md
