# Surfaces in space by one command: of boxes, of axisymmetric runs turned about their axis, with cuts, as films, beside each other;
# what cannot be is said.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
run() { # DIR LOWER UPPER CELLS BOUNDARIES CENTER [GEOMETRY]
    cat >"$1.yaml" <<CASE
bulla: 1
title: A ball of gas in water
domain:
  geometry: ${7:-cartesian}
  lower: [$2]
  upper: [$3]
  cells: [$4]
  boundaries: {$5}
mesh: {tile: 8}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 6e8}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: water, density: 998, pressure: 1 bar}
  - {sphere: {center: [$6], radius: 0.3 mm}, material: air, density: 1.2, pressure: 1 bar}
run: {until: 2 us, max-steps: 2}
output: {directory: $1, snapshots: {every: 1 step, fields: [pressure, velocity, alpha_air]}}
CASE
    "$BULLA" run "$1.yaml" --quiet
}
walls='x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting'
run box '0, 0, 0' '1 mm, 1 mm, 1 mm' '16, 16, 16' "$walls, z-: reflecting, z+: reflecting" '0.5 mm, 0.5 mm, 0.5 mm'
run turned '0, 0' '0.5 mm, 1 mm' '16, 32' 'x-: axis, x+: outflow, y-: reflecting, y+: reflecting' '0, 0.5 mm' axisymmetric
run flat '0, 0' '1 mm, 1 mm' '16, 16' "$walls" '0.5 mm, 0.5 mm'
plot="$BULLA plot"
width="--width 300"

for dir in box turned; do
    $plot $dir --iso alpha_air=0.5 $width >out
    [ "$(cat out)" = "$dir/plots/${dir}_000002_iso.png" ] && [ -s "$(cat out)" ] || fail "no picture" out
    $plot $dir --iso alpha_air=0.5 $width -o $dir.png >out
    cmp $dir.png $dir/plots/${dir}_000002_iso.png
    $plot $dir --iso alpha_air=0.5 $width -o $dir-left.png --view=-60,10 >out
    ! cmp -s $dir.png $dir-left.png || fail "the viewer stays"
    $plot $dir pressure --iso alpha_air=0.5 --slice y=0.1mm --slice z=0.5mm $width -o $dir-cut.png >out
    $plot $dir velocity --iso alpha_air=0.5 $width >out
    [ "$(cat out)" = "$dir/plots/${dir}_000002_velocity_iso.png" ] || fail "the name" out
    $plot $dir --iso alpha_air=0.5 --xlim 0,0.4mm --zlim 0.2mm,0.8mm $width -o $dir-near.png >out
done

# A ball is the same from opposite sides; one that is cut by nothing is not that of another level.
$plot box --iso alpha_air=0.5 $width --view 0,0 -o front.png >out
$plot box --iso alpha_air=0.9 $width --view 0,0 -o inner.png >out
! cmp -s front.png inner.png

# A film has one scale, and frames for all snapshots; runs stand beside each other with and without a field.
PATH=$PWD $plot box velocity --iso alpha_air=0.5 --movie film.mp4 $width >out 2>err
[ "$(ls "$(cat out)" | wc -l)" = 3 ]
$plot box turned --iso alpha_air=0.5 --beside $width >out
[ "$(cat out)" = box/plots/beside_iso.png ]
$plot box turned pressure --iso alpha_air=0.5 --beside $width -o two.png >out

# A level that the field does not have yet is an empty box, not a failure: films begin so.
$plot box pressure --iso velocity=1e9 $width -o none.png >out

refused "surfaces need a run in space" $plot flat --iso alpha_air=0.5
refused "no field 'alpha_ait'.*did you mean 'alpha_air'" $plot box --iso alpha_ait=0.5
refused "a field and a value are needed" $plot box --iso alpha_air
refused "'half' is no number" $plot box --iso alpha_air=half
refused "which field colours the cut" $plot box --iso alpha_air=0.5 --slice z=0.5mm
refused "the box reaches from 0 to 0.001" $plot box pressure --iso alpha_air=0.5 --slice z=2mm
refused "the box reaches from 0 to 0.001" $plot box --iso alpha_air=0.5 --zlim 2mm,3mm
refused "two angles" $plot box --iso alpha_air=0.5 --view 30
refused "between -90 and 90" $plot box --iso alpha_air=0.5 --view 30,100
refused "--view is for surfaces" $plot box pressure --view 30,10
refused "--zlim is for surfaces" $plot box pressure --zlim 0,1
refused "which field" $plot box
refused "more than 4 times" $plot box --iso pressure=1 --iso pressure=2 --iso pressure=3 --iso pressure=4 --iso pressure=5
