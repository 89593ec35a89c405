# Every rank makes and checks its own piece of the tile sets, and knows nothing but what lies around it: on 1, 7 and 16 ranks (at
# night, BULLA_WHOLE, on 2, 3 and 4, too) the same sets, counts of unwanted tiles and bits, in 2D with three levels that come,
# move and go, and in 3D; a checkpoint of 16 ranks goes on with 5 and then with 1; a rank that is lost ends the run, and its
# checkpoint goes on.
# BULLA_RANKS: in place of 16 (32 at night).
set -eu
many=${BULLA_RANKS:-16}
. "$BULLA_SOURCE/tests/lib.sh"
same="$BULLA_BUILD/tests/test-unit-checkpoint"

drifting 32 16 >moving.yaml
cat >>moving.yaml <<'END2'
output:
  snapshots: {every: 100 steps, fields: [density, pressure, alpha_air, level], precision: double}
  history: {columns: {m: {mass: air}, E: {total: energy}, pmax: {max: pressure}}}
  checkpoints: {every: 4 steps, keep: 9}
END2
cat >space.yaml <<'END2'
bulla: 1
title: A drop of gas drifts in 3D
domain: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [16, 16, 16], boundaries: {x-: periodic, x+: periodic, y-: outflow, y+: outflow, z-: reflecting, z+: outflow}}
mesh: {levels: 2, tile: 4, regrid-every: 2, buffer: 2, patience: 1, refine: [{jump: density, above: 0.1}]}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: 1e5, velocity: [900, 200, 0]}
  - {sphere: {center: [0.6, 0.5, 0.4], radius: 0.2}, material: air, density: 2, pressure: 1e5, velocity: [900, 200, 0]}
run: {until: 1, max-steps: 6}
output:
  snapshots: {every: 100 steps, fields: [density, pressure, level], precision: double}
  history: {columns: {E: {total: energy}}}
  checkpoints: {every: 3 steps, keep: 9}
END2
while read -r name counts; do
    # shellcheck disable=SC2086
    ranked "$name" $counts
    for folder in "$name"-*; do # those numbers of ranks that were run
        for file in $name-1/out/checkpoints/*; do
            "$same" "$file" "$folder/out/checkpoints/${file##*/}"
        done
    done
    grep -q '"regrids": *[3-9]' "$name-1/refinement" || grep -q '"regrids": *[1-9][0-9]' "$name-1/refinement" || fail "$name: levels do not move"
done <<END2
moving 1 2 4 7 $many
space 1 3 7
END2

cp -r "moving-$many" chain
ran chain moving -n 5 --max-steps 11 --restart=out/checkpoints/moving_000004.chk
ran chain moving --restart
cmp moving-1/out/history.csv chain/out/history.csv

# killed when its first checkpoint is there
ranks_of() { ps -o pid=,comm=,stat= -s "$1" | awk -v first="$1" '$2 == "bulla" && $3 !~ /^Z/ && $1 != first { print $1 }'; }
saved() { ls lost/out/checkpoints/*.chk >/dev/null 2>&1 || ! alive "$run"; }
lose() { # one of three ranks; false: the run was over
    rm -rf lost
    mkdir lost
    cp moving.yaml lost
    start sh -c "cd lost && exec '$BULLA' run moving.yaml -o out --quiet -n 3" >said 2>&1
    await "a checkpoint" saved
    victim=$(ranks_of "$run" | tail -n 1)
    [ -n "$victim" ] || { ended "$run"; return 1; }
    kill -9 "$victim"
    if lingers "$run"; then killed "$run"; else ended "$run"; fi # mpirun may hang on its way out
    [ "$code" != 0 ]
}
insist lose
ran lost moving -n 2 --restart
cmp moving-1/out/history.csv lost/out/history.csv
