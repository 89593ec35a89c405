# Pictures of real runs: one, two and three dimensions, every way to choose and to cut.
set -eu
unset DISPLAY || true
size() { # "width height" of a PNG, from its header
    od -An -tu1 -j16 -N8 "$1" | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4, (($5 * 256 + $6) * 256 + $7) * 256 + $8 }'
}
written() { # FILE COMMAND...: prints FILE as its last line, which is then a picture with something in it
    file=$1
    shift
    [ "$("$@" | tail -n 1)" = "$file" ] || { echo "not $file: $*"; exit 1; }
    [ "$(wc -c <"$file")" -gt 8000 ] || { echo "$file is nearly empty"; exit 1; }
}
refused() { # PATTERN COMMAND...
    pattern=$1
    shift
    code=0
    "$@" >out 2>err || code=$?
    [ "$code" = 2 ] || { echo "exit code $code: $*"; cat err; exit 1; }
    grep -q -- "$pattern" err || { echo "no '$pattern' in:"; cat err; exit 1; }
}
case_file() { # NAME GEOMETRY LOWER UPPER CELLS CENTRE FACES: a bubble that an excess pressure squeezes
    cat >"$1.yaml" <<CASE
bulla: 1
title: A bubble in $1
about: for pictures
cite: none
domain:
  geometry: $2
  lower: $3
  upper: $4
  cells: $5
  boundaries: $7
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: water, density: 998.2, pressure: 35 MPa}
  - {sphere: {center: $6, radius: 0.04 mm}, material: air, density: 1.225, pressure: 101325}
scheme: {closure: kapila, riemann: hllc, limiter: mc, cfl: 0.4}
run: {until: 20 ns}
output:
  snapshots: {every: 10 ns, fields: [pressure, density, velocity, schlieren, alpha_air, alpha_water]}
  history: {every: 1 step, columns: {V: {volume: air}, pmax: {max: pressure}}}
CASE
    rm -rf "$1"
    "$BULLA" run "$1.yaml" -o "$1" --quiet
}

case_file ring axisymmetric '[0, -0.1 mm]' '[0.1 mm, 0.1 mm]' '[32, 64]' '[0, 0]' \
    '{x-: axis, x+: outflow, y-: outflow, y+: outflow}'
last=$(ls ring/fields/ring_*.hdf | tail -n 1 | sed 's/.*ring_0*\([0-9]*\).hdf/\1/')
name=$(printf 'ring_%06d' "$last")
written "ring/plots/${name}_pressure.png" "$BULLA" plot ring pressure
written "ring/plots/${name}_density.png" "$BULLA" plot ring pressure,density --mirror --tiles
written half.png "$BULLA" plot ring pressure --step 0 -o half.png --width 500
[ "$(size half.png | cut -d ' ' -f 1)" = 500 ]
written "ring/plots/${name}_velocity+schlieren.png" "$BULLA" plot ring --left velocity --right schlieren
written wide.png "$BULLA" plot ring velocity_y --ylim -10um,10um --range -5,5 --map ember --contour air -o wide.png
set -- $(size wide.png)
[ "$1" -gt "$((3 * $2 / 2))" ] # a strip gets its colour bar below
written axis.png "$BULLA" plot ring pressure --slice r=0 --log -o axis.png
"$BULLA" plot ring pressure --all --contour none >all
[ "$(wc -l <all)" = "$(ls ring/fields/ring_*.hdf | wc -l)" ]
[ "$(while read -r file; do size "$file"; done <all | sort -u | wc -l)" = 1 ] # frames of a film
written ring/plots/history.png "$BULLA" plot ring history
refused "no field 'presure' in the snapshots (did you mean 'pressure'?)" "$BULLA" plot ring presure
refused "the nearest is --step $last" "$BULLA" plot ring pressure --step 999999
refused "no such material (did you mean 'air'?)" "$BULLA" plot ring pressure --contour ait
refused "the domain reaches from" "$BULLA" plot ring pressure --xlim 1,2
refused "no colour map 'embers' (did you mean 'ember'?)" "$BULLA" plot ring pressure --map embers
refused "name a directory" "$BULLA" plot ring pressure --all -o one.png
refused "the run has 2 dimensions" "$BULLA" plot ring pressure --slice z=0

written report.html "$BULLA" report ring -o report.html
[ "$(grep -c '<figure>' report.html)" = 10 ] # history, six fields, three frames

case_file line spherical '[0]' '[0.2 mm]' '[64]' '[0]' '{x-: symmetry, x+: outflow}'
"$BULLA" plot line pressure,density,alpha_air,alpha_water -o line.png --width 600
[ "$(size line.png | cut -d ' ' -f 1)" = 600 ]

case_file box cartesian '[-0.1 mm, -0.1 mm, -0.1 mm]' '[0.1 mm, 0.1 mm, 0.1 mm]' '[16, 16, 16]' '[0, 0, 0]' \
    '{x-: outflow, x+: outflow, y-: outflow, y+: outflow, z-: outflow, z+: outflow}'
written middle.png "$BULLA" plot box density -o middle.png
written edge.png "$BULLA" plot box density --slice x=0.1mm -o edge.png
! cmp -s middle.png edge.png
written cut.png "$BULLA" plot box density --slice x=0 --slice y=0 -o cut.png
refused "nothing is left" "$BULLA" plot box density --slice x=0 --slice y=0 --slice z=0
refused "axisymmetric" "$BULLA" plot box density --mirror

# Histories of several runs on one picture: a panel for each column, a line for each run.
written line/plots/compare.png "$BULLA" plot line/ ring box history V pmax
written alone.png "$BULLA" plot line history V pmax -o alone.png
written two.png "$BULLA" plot line ring history V pmax -o two.png
! cmp -s two.png line/plots/compare.png
! cmp -s two.png alone.png
mkdir other
cp -r line other/line # of one name: told apart by their paths
written same.png "$BULLA" plot line other/line history V -o same.png
refused "ring: no column 'W'; there are: step, dt, V, pmax" "$BULLA" plot ring line history W
refused "which columns of the 2 runs" "$BULLA" plot line ring history
refused "10 runs in one picture: at most 9" "$BULLA" plot line line line line line line line line line line history V
refused "no history.csv and no probes.csv in other" "$BULLA" plot ring other history V
refused "bulla plot line ring history COLUMN" "$BULLA" plot line ring pressure
refused "no directory nowhere" "$BULLA" plot nowhere line history V
