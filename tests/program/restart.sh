# A run that was stopped and taken up again gives the same bits as one that was not: checkpoints, snapshots, history
# and probes, on the same number of ranks or another one, with schedules that the stop falls between, columns that
# remember the start, a boundary in Lua, repaired cells; also when the end time is moved.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
same="$BULLA_BUILD/tests/test-unit-checkpoint"
fields="$BULLA_BUILD/tests/test-unit-snapshot"

cat >bubble.yaml <<'END'
bulla: 1
title: A wave meets a bubble
domain:
  geometry: axisymmetric
  lower: [0, -1 mm]
  upper: [1 mm, 1 mm]
  cells: [24, 48]
  boundaries:
    x-: axis
    x+: non-reflecting
    y-: reflecting
    y+: {type: incoming-wave, pulse: lua, lua: "function(t, x, y) return 1e7 * math.sin(1e7 * t) * (1 + x) end"}
mesh: {tile: 8}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1 bar}
  - {half-space: {point: [0, 0.7 mm], normal: [0, 1]}, material: water, density: 1010, pressure: 300 bar}
  - {sphere: {center: [0, 0], radius: 0.5 mm}, material: air, density: 1.2, pressure: 1 bar}
run: {until: 1 us, max-steps: 40}
output:
  directory: out
  snapshots: {every: 15 ns, fields: [density, velocity, pressure, alpha_air], precision: double}
  checkpoints: {every: 13 steps, keep: 3}
  history:
    every: 3 steps
    columns:
      V: {volume: air}
      depth: {penetration: air}
      R: {equivalent-radius: air}
      ratio: {value: V / depth + t}
  probes:
    every: 7 ns
    top: {at: [0.333 mm, 0.333 mm], fields: [pressure, velocity]}
END

# Steps that the guard redoes, halves and relaxes: at last to a 1e8th.
{ parting 'closure: allaire' 18; cat <<'END'; } >parting.yaml
output:
  directory: out
  snapshots: {every: 4 steps, fields: [density, velocity, pressure, alpha_air], precision: double}
  checkpoints: {every: 5 steps, keep: 3}
  history: {columns: {m: {mass: air}, E: {total: energy}, pmin: {min: pressure}}}
  probes: {every: 1 steps, in: {at: [0.1, 0], fields: [pressure, velocity]}}
END
sed 's/closure: allaire/closure: kapila/' parting.yaml >relaxing.yaml

# Levels that come and go: a shock that runs, a bubble that stays, patience that is counted across the stop.
sed 's/^mesh:.*/mesh: {tile: 8, levels: 2, regrid-every: 2, buffer: 2, patience: 2, refine: [{interface: air}, '\
'{gradient: pressure, above: 0.05, relative: true}]}/; s/max-steps: 40/max-steps: 32/' bubble.yaml >levels.yaml

run() { # FOLDER CASE OPTIONS...: in a folder of its own, so that the outputs have the same names
    folder=$1 name=$2
    shift 2
    mkdir -p "$folder"
    cp "$name.yaml" "$folder"
    (cd "$folder" && "$BULLA" run "$name.yaml" --quiet "$@")
}
compare() { # FOLDER FOLDER CASE; older snapshots hold another case.yaml: that of the first part
    for file in history.csv probes.csv "fields/$3.hdf.series"; do cmp "$1/out/$file" "$2/out/$file"; done
    (cd "$1/out" && ls -- fields checkpoints) >one
    (cd "$2/out" && ls -- fields checkpoints) >two
    cmp one two
    for file in $(cd "$1/out/fields" && ls | grep '_0000[2-4].\.hdf$\|_00001[0-9]\.hdf$' | tail -n 3); do
        "$fields" "$1/out/fields/$file" "$2/out/fields/$file"
    done
    for file in "$1"/out/checkpoints/*.chk; do "$same" "$file" "$2/out/checkpoints/${file##*/}"; done
}
guards() { sed -n '/"guard"/,/}/p' "$1/out/provenance.json"; }

rm -rf whole-* part-*
for name in bubble levels; do
    run whole-$name $name
    for ranks in "1 1" "1 2" "2 1" "2 3"; do
        rm -rf part-$name
        run part-$name $name -n "${ranks% *}" --max-steps 15
        [ -e part-$name/out/checkpoints/${name}_000015.chk ] || { echo "no checkpoint of the last step"; exit 1; }
        run part-$name $name -n "${ranks#* }" --restart
        rm -f whole-$name/out/checkpoints/*_000013.chk part-$name/out/checkpoints/*_00001[35].chk
        compare whole-$name part-$name $name
    done
done
"$BULLA" info whole-levels/out/checkpoints/levels_000032.chk | grep -q '^level 2 .*cells$' || { echo "no levels"; exit 1; }
grep -q '"regrids": *[1-9]' whole-levels/out/provenance.json || { echo "no regrids"; exit 1; }
grep -q '"runs": 2' part-bubble/out/provenance.json
if "$same" whole-bubble/out/checkpoints/bubble_000026.chk whole-bubble/out/checkpoints/bubble_000039.chk 2>/dev/null; then
    echo "the comparison finds no difference between two steps"
    exit 1
fi

for name in parting relaxing; do
    run whole-$name $name
    run part-$name $name --max-steps 7 -n 2
    run part-$name $name --restart
    compare whole-$name part-$name $name
    guards whole-$name >one
    guards part-$name >two
    cmp one two
done
guards part-parting | grep -q '"retries": *[1-9]'
guards part-relaxing | grep -q '"relaxed": *[1-9]'

# From a named file into another directory: the rows of the past come along.
run part-other bubble -o elsewhere --restart ../whole-bubble/out/checkpoints/bubble_000026.chk
for file in history.csv probes.csv; do cmp "whole-bubble/out/$file" "part-other/elsewhere/$file"; done
"$same" whole-bubble/out/checkpoints/bubble_000040.chk part-other/elsewhere/checkpoints/bubble_000040.chk

# A finished run goes on when its end is moved: 75 ns is a time of output, so the whole run stops there, too.
run whole-later bubble --set 'run.until=165 ns'
run part-later bubble --until '75 ns'
run part-later bubble --restart --set 'run.until=165 ns'
for file in history.csv probes.csv fields/bubble.hdf.series; do cmp whole-later/out/$file part-later/out/$file; done
last=$(cd whole-later/out/checkpoints && ls | tail -n 1)
"$same" "whole-later/out/checkpoints/$last" "part-later/out/checkpoints/$last"

# Another scheme and other ranks are no other case.
run part-later bubble --restart --until '170 ns' --set scheme.cfl=0.2 -n 2
