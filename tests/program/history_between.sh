# Rows at the steps of the finest level, and extremes between rows. The extremes are those of the rows of a run that
# writes all of them; rows at whole steps are those of a run that writes no others; sums of levels that wait are not taken
# again, and are as if they were. The same bits on any number of ranks and after a restart.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >blast.yaml <<'END2'
bulla: 1
title: A blast meets a bubble, on levels that move
domain: {lower: [0, 0], upper: [1, 1], cells: [16, 16], boundaries: {x-: reflecting, x+: non-reflecting, y-: symmetry, y+: reflecting}}
mesh: {levels: 3, tile: 4, regrid-every: 2, buffer: 2, patience: 1, refine: [{interface: air}, {jump: pressure, above: 0.5, finest: 2}]}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1e5}
  - {sphere: {center: [0.3, 0.2], radius: 0.1}, material: water, density: 1100, pressure: 3e8}
  - {sphere: {center: [0.55, 0.06], radius: 0.1}, material: air, density: 1.2, pressure: 1e5}
run: {until: 1, max-steps: 14}
output:
  snapshots: {every: 20 us, fields: [pressure]}
  checkpoints: {every: 5 steps}
  history:
    steps-of: finest
    columns:
      V: {volume: air}
      E: {total: energy}
      p: {max: pressure}
      low: {min: pressure, where: {sphere: {center: [0.6, 0.1], radius: 0.2}}}
      steep: {min: schlieren}
      warm: {mean: temperature_air, in: air}
      skin: {isosurface-mean: pressure, in: air}
      depth: {penetration: air, along: x}
      V_least: {min-between: V}
      p_most: {max-between: p}
      low_least: {min-between: low}
      ratio: {value: p_most / p}
      product: {value: p * V * t}
      product_most: {max-between: product}
END2

run() { # FOLDER OPTIONS...
    folder=$1
    shift
    mkdir -p "$folder"
    cp blast.yaml "$folder"
    (cd "$folder" && "$BULLA" run blast.yaml --quiet -o out "$@" </dev/null) || fail "$folder $*"
}
same() { cmp "$1/out/history.csv" "$2/out/history.csv"; }

# Every step of the finest level has a row: more than one for each step, as many as the finest level took.
run all
steps=$(sed -n '/"levels"/,/\]/p' all/out/provenance.json | grep -o '"steps": *[0-9]*' | sed 's/.* //' | tail -n 1)
rows=$(($(wc -l <all/out/history.csv) - 2))
[ "$rows" -eq "$steps" ] && [ "$steps" -ge 112 ] || fail "$rows rows, $steps steps of the finest level"
awk -F, 'NR > 2 && !($2 > t) { print "times do not grow: " $0; exit 1 }
    NR > 2 && ($2 - t - $3 > 1e-9 * $3 || t + $3 - $2 > 1e-9 * $3) { print "dt is not the step: " $0; exit 1 }
    { t = $2 }' all/out/history.csv || fail "times"
# without extremes to look for, nothing is left to keep
awk -F, 'NR > 1 && ($12 != $4 || $13 != $6 || $17 != $16) { print "an extreme of one row is another: " $0; exit 1 }' \
    all/out/history.csv || fail "extremes of single rows"

# Whole steps as without the others.
run coarse --set output.history.steps-of=coarsest
awk -F, 'NR > 1 { at[$1] = $0 } END { for (i = 0; i <= 14; i++) { n = split(at[i], x, ","); line = x[1]
    for (k = 2; k <= n; k++) if (k != 3) line = line "," x[k]; print line } }' all/out/history.csv >all.whole
awk -F, 'NR > 1 { line = $1; for (k = 2; k <= NF; k++) if (k != 3) line = line "," $k; print line }' \
    coarse/out/history.csv >coarse.whole
cmp all.whole coarse.whole || fail "rows of whole steps" all.whole coarse.whole

# Extremes over windows: every 9 steps of the finest level; by time; whole steps.
extremes() { # FOLDER: the columns t, V_least, p_most, low_least, product_most that rows of `all` give at the times of FOLDER
    awk -F, 'FNR == 1 { file++; next }
        file == 1 { at[$2] = ++n; next }
        { if (!m++) { v = $4; p = $6; l = $7; q = $16 }
          if ($4 < v) v = $4; if ($6 > p) p = $6; if ($7 < l) l = $7; if ($16 > q) q = $16
          if ($2 in at) { print $2, v, p, l, q; m = 0 } }' "$1/out/history.csv" all/out/history.csv >"$1.want"
    awk -F, 'NR > 1 { print $2, $12, $13, $14, $17 }' "$1/out/history.csv" >"$1.have"
    cmp "$1.want" "$1.have" || fail "extremes of $1" "$1.want" "$1.have"
    [ "$(wc -l <"$1.have")" -gt 4 ] || fail "$1: few rows" "$1.have"
}
# Between rows the run looks at fewer columns, so that rows take all sums anew: they are those of a run that kept them.
as_kept() { # FOLDER
    awk -F, -v OFS=, '{ $12 = $13 = $14 = $15 = $17 = "" } NR == FNR { at[$2] = $0; next }
        $2 in at { n++; if (at[$2] != $0) { print at[$2]; print $0; exit 1 } } END { exit n < 5 }' \
        all/out/history.csv "$1/out/history.csv" || fail "sums of $1"
}
run nine --set 'output.history.every=9 steps'
extremes nine
as_kept nine
run times --set 'output.history.every=20 us'
extremes times
as_kept times
[ "$(awk -F, 'NR > 1 && $13 > $6' times/out/history.csv | wc -l)" -gt 2 ] || fail "no extreme lies between two rows"

# Ranks, restart.
for ranks in 2 3; do
    run all-$ranks -n $ranks
    same all all-$ranks
    run nine-$ranks -n $ranks --set 'output.history.every=9 steps'
    same nine nine-$ranks
done
for every in '9 steps' '20 us' '1 step'; do
    rm -rf part whole
    run whole --set "output.history.every=$every"
    run part --set "output.history.every=$every" --max-steps 7
    run part --set "output.history.every=$every" --restart -n 2
    same whole part
done

# Steps without subcycling; levels that a case does not have.
run plain --set mesh.subcycle=false --max-steps 4
[ "$(wc -l <plain/out/history.csv)" -eq 6 ]
run flat --set mesh.levels=0 --max-steps 4
run flat-coarse --set mesh.levels=0 --set output.history.steps-of=coarsest --max-steps 4
same flat flat-coarse
grep -q '^history.csv,p_most,Pa$' all/out/columns.csv
grep -q '^history.csv,product_most,$' all/out/columns.csv

# What makes no sense.
refused() { # MESSAGE COLUMN
    code=0
    "$BULLA" check blast.yaml --set "output.history.columns.odd=$2" >said 2>&1 || code=$?
    [ "$code" -eq 2 ] || fail "$2: exit code $code" said
    grep -q "$1" said || fail "$2: not '$1'" said
}
refused "'W' is no column further up" '{min-between: W}'
refused "'odd' is no column further up" '{max-between: odd}'
refused "'p_most' is itself an extreme between rows" '{max-between: p_most}'
refused "'where' goes with what is measured" '{max-between: p, where: {sphere: {center: [0, 0], radius: 1}}}'
refused "one measure per column" '{max-between: p, min: pressure}'
