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

# Hard scenes: every combination a line, what is not allowed counts nowhere, a run that stops is named.
cd ..
mkdir -p there/cases/verify there/cases/hard there/docs
cp tube.yaml there/cases/verify/
cd there
{ grep -v '^matrix' ../tube.yaml; echo 'quick: {domain: {cells: [32]}}'; } >cases/hard/h1-tube.yaml
sed 's/pressure: 0.1/pressure: 1/; s/exact-riemann/mirror-x/; s/, order: 0.5//' cases/hard/h1-tube.yaml >cases/hard/h2-even.yaml
sed 's/pressure: 0.1/pressure: 0.01/' cases/hard/h1-tube.yaml >cases/hard/h10-strong.yaml
cat >cases/hard.yaml <<'END2'
title: A few
matrix:
  scheme.riemann: [hllc, no-such-solver]
  scheme.limiter + scheme.interface-limiter: [mc + superbee, koren + thinc]
  scheme.cfl: [0.4]
END2
printf '<!-- verify hard -->\n<!-- end hard -->\n' >docs/hard.md
expect_code 0 "$BULLA" verify hard --save
grep -q '^| | riemann | limiter + interface-limiter | cfl | finish |' docs/hard.md
grep -q '^| 1 | hllc | mc + superbee | 0.4 | 3/3 | 2 | 0/1 | 1.00 |' docs/hard.md
grep -q '^| 2 | hllc | koren + thinc | 0.4 | 3/3 |' docs/hard.md
grep -q '^| 3 | no-such-solver | mc + superbee | 0.4 | 0/0 |' docs/hard.md
grep -q '^| h2-even |.* ok skew |' docs/hard.md
awk -F '|' '/^\| h/ {print $2}' docs/hard.md | tr -d ' \n' | grep -q '^h1-tubeh2-evenh10-strong$'
expect_code 0 "$BULLA" verify hard h10
[ "$(grep -c '^| h' stdout)" = 1 ]
expect_code 2 "$BULLA" verify hard h7

# Beside: what changes is a line with the error that grows most, what does not is counted; both settings count.
cp cases/hard/h1-tube.yaml cases/verify/tube-a.yaml
sed 's/limiter: mc//; s/^scheme.*//' ../tube.yaml >cases/verify/tube-b.yaml # without a coarse variant
printf '# Beside\n' >docs/beside.md
expect_code 0 "$BULLA" verify tube-a tube-b --beside scheme.limiter=minmod --save
grep -q '^| tube-a | L1(density) |.* | yes | ' docs/beside.md
grep -q '^| tube-b | L1(density) |' docs/beside.md
[ "$(grep -o '\*\*[0-9.]*\*\*' docs/beside.md | wc -l)" = 2 ] # minmod is worse by more than 15 %
grep -q '^2 scenes, 0 of them without any change' docs/beside.md
expect_code 0 "$BULLA" verify tube-a --set scheme.limiter=minmod --beside scheme.limiter=minmod
grep -q '^## scheme.limiter=minmod beside scheme.limiter=minmod' stdout
grep -q '^1 scenes, 1 of them without any change' stdout
expect_code 0 "$BULLA" verify tube-a --beside scheme.limiter=no-such-limiter
grep -q '^| tube-a |.* | yes | \*\*stops\*\* |' stdout
expect_code 2 "$BULLA" verify tube-a --set scheme.cfl=0.2
grep -q 'goes with --beside' stderr

# Error against cost: every scheme a line, the front marked, rows of others, a picture.
cat >cases/cost.yaml <<'END2'
schemes: {mc: {cfl: 0.4}, minmod: {limiter: minmod, cfl: 0.4}, wrong: {limiter: nothing}}
scenes:
  tube:
    case: verify/tube
    error: L1(pressure)
    set: {expect: [{norm: L1, field: density, reference: exact-riemann, at-most: 1}, {norm: L1, field: pressure, reference: exact-riemann, at-most: 1}]}
    matrix: {domain.cells: [[32], [64]]}
    others: {theirs: [[2, 0.01], [4, 0.005]]}
END2
expect_code 0 "$BULLA" verify --cost tube
grep -q '^| scheme | 32 | 64 |' stdout
grep -q '^| wrong | - | - |' stdout
grep -q '^theirs: 0.01 in 2 s, 0.005 in 4 s.' stdout
[ -s out/verify/cost/tube.png ]
grep -q '^mc,64,.*,front$' out/verify/cost/tube.csv
[ "$(grep -c ',other$' out/verify/cost/tube.csv)" = 2 ]
"$BULLA" run cases/verify/tube.yaml --quiet --overwrite -o own --set 'domain.cells=[32]' --set 'scheme.cfl=0.4' \
    --set 'expect.0.field=pressure'
own=$(sed -n 's/.*"value": //p' own/expect.json | tr -d ,)
awk -F, -v own="$own" '/^mc,32/ {exit ($3 / own - 1)^2 > 1e-8}' out/verify/cost/tube.csv
expect_code 2 "$BULLA" verify --cost nothing
grep -q "no scene 'nothing'" stderr
