# Peaks over time: the same bits on 1, 2 and 3 ranks and after a restart, with levels that come and go; nothing a cell has
# seen is lost when the mesh changes; files and pictures show them; what cannot be kept is refused, and what a checkpoint has
# not got begins anew.
set -eu
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

cat >none.yaml <<'END'
bulla: 1
title: A blast in a corner
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: reflecting, x+: outflow, y-: reflecting, y+: outflow}}
mesh: {tile: 8, levels: 2, regrid-every: 2, refine: [{jump: pressure, above: 20 kPa}]}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}
  - {sphere: {center: [0.2, 0.1], radius: 0.08}, material: air, density: 3, pressure: 4e5}
run: {until: 0.4 ms}
output:
  directory: out
  checkpoints: {every: 4 steps}
  history: {columns: {p: {max: pressure}}}
END
cat >blast.yaml <<'END'
extends: none.yaml
output:
  snapshots: {every: 1 ms, fields: [pressure, max_pressure, when_min_pressure]}
  history:
    columns: {q: {min: pressure}, most: {max: max_pressure}, least: {min: min_pressure}, mean: {mean: max_pressure},
      low: {mean: min_pressure}, when: {mean: when_max_pressure}, u: {mean: max_velocity}, s: {mean: max_schlieren}}
END
for ranks in 1 2 3; do
    "$BULLA" run blast.yaml -o ranks-$ranks -n $ranks --quiet
    cmp ranks-1/history.csv ranks-$ranks/history.csv
done
"$BULLA" run blast.yaml -o again -n 2 --max-steps 8 --quiet
"$BULLA" run blast.yaml -o again --restart -n 3 --quiet
cmp ranks-1/history.csv again/history.csv

# What has been seen stays: means over all cells only rise (fall), and no row is above (below) what is kept.
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    { p = $at["p"]; q = $at["q"]; mean = $at["mean"]; low = $at["low"]
      if (p > $at["most"] || q < $at["least"]) { print "a row beyond its peak: " $0; exit 1 }
      if (NR > 2 && (mean < was * (1 - 1e-12) || low > were * (1 + 1e-12))) { print "a peak was lost: " $0; exit 1 }
      was = mean; were = low }
    END { exit !(NR > 10 && mean > 1.05e5 && low < 1e5 && $at["when"] > 1e-5 && $at["u"] > 1 && $at["s"] > 0) }' ranks-1/history.csv

# A pulse of known height and speed, behind which the mesh is coarse again.
"$BULLA" run "$BULLA_SOURCE/cases/verify/peaks.yaml" -o pulse --quiet

# In files and pictures.
"$BULLA" info ranks-1/fields/blast_000000.hdf >first
grep -q '^max_pressure *Pa *100000 *400000$' first || { cat first; exit 1; }
grep -q '^when_min_pressure *s *0 *0$' first || { cat first; exit 1; }
"$BULLA" plot ranks-1 max_pressure -o peak.png >/dev/null
test -s peak.png

# Only a part of the time: nothing before it.
"$BULLA" run blast.yaml -o late --set output.peaks.from=0.2ms --quiet
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    $at["t"] < 0.2e-3 && $at["most"] != "nan" { print "too early: " $0; exit 1 }
    END { exit !($at["most"] > 1.05e5) }' late/history.csv
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } END { exit !($at["when"] >= 0.2e-3) }' late/history.csv

# Other peaks than the checkpoint has: they begin anew, and the run says so.
"$BULLA" run blast.yaml -o new --max-steps 8 --quiet
"$BULLA" run blast.yaml -o other --restart "$(ls new/checkpoints/*.chk | tail -1)" --set output.snapshots.fields='[max_density]' \
    --max-steps 9 2>said >said
grep -q 'not the same peaks' said || { cat said; exit 1; }

refused() { # SETTING WORDS: is refused with these words
    if "$BULLA" check blast.yaml --set "$1" >out.txt 2>&1; then cat out.txt; exit 1; fi
    grep -q "$2" out.txt || { cat out.txt; exit 1; }
}
refused output.snapshots.fields='[max_presure]' "there is no field 'max_presure'"
refused output.snapshots.fields='[max_max_pressure]' "there is no field"
refused output.snapshots.fields='[max_rank]' "there is no field"
refused output.peaks='{from: 2 us, until: 1 us}' "is before 'from'"
"$BULLA" check none.yaml >/dev/null
if "$BULLA" check none.yaml --set output.peaks='{from: 1 us}' >out.txt 2>&1; then cat out.txt; exit 1; fi
grep -q 'no list of fields names one' out.txt || { cat out.txt; exit 1; }
# Without peaks nothing is kept: not in memory, not in the checkpoint, and the same numbers.
"$BULLA" run none.yaml -o none --quiet
cut -d, -f1-4 ranks-1/history.csv >with
cut -d, -f1-4 none/history.csv >without
cmp with without
