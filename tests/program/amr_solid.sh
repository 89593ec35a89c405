# Levels with a solid give the same bits on 1, 2 and 3 ranks, and so does a run that is stopped and continued on another
# number: a shock meets a stretched block beside a bubble, in the plane with motion across it, and round an axis.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
fields="$BULLA_BUILD/tests/test-unit-snapshot" same="$BULLA_BUILD/tests/test-unit-checkpoint"

materials='materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  tissue:
    eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}
    constitutive: {type: neo-hookean, shear-modulus: 50 MPa, reference-density: 1000}'
output='output:
  directory: out
  checkpoints: {every: 8 steps, keep: 9}
  snapshots: {every: 100 steps, fields: [density, velocity, pressure, alpha_tissue, stress_xx, stretch_xy, level], precision: double}
  history:
    columns: {V: {volume: air}, m: {mass: tissue}, pmax: {max: pressure}, E: {total: energy}}'

cat >plane.yaml <<END2
bulla: 1
title: A blast, a bubble and a block that is sheared
domain:
  lower: [0, 0]
  upper: [1, 1]
  cells: [24, 24]
  velocity-components: 3
  boundaries: {x-: periodic, x+: periodic, y-: reflecting, y+: non-reflecting}
mesh: {levels: 2, tile: 4, regrid-every: 2, buffer: 2, patience: 1, refine: [{jump: alpha_tissue, above: 0.1}, {jump: pressure, above: 0.5}]}
$materials
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: [20, 10, 0]}
  - {sphere: {center: [0.2, 0.5], radius: 0.12}, material: water, density: 1050, pressure: 1e8, velocity: [20, 10, 0]}
  - {box: {lower: [0.45, 0.3], upper: [0.7, 0.75]}, material: tissue, density: 1000, pressure: 1e5, velocity: [20, 10, '= 20 * y'], stretch: {xx: 1.1, xy: 0.1}}
  - {sphere: {center: [0.8, 0.6], radius: 0.1}, material: air, density: 1.2, pressure: 1e5, velocity: [20, 10, 0]}
run: {until: 1, max-steps: 20}
$output
END2

cat >round.yaml <<END2
bulla: 1
title: A bubble collapses at a soft wall
domain: {geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [16, 16], boundaries: {x-: axis, x+: outflow, y-: outflow, y+: reflecting}}
mesh: {levels: 2, tile: 4, regrid-every: 2, buffer: 2, patience: 1, refine: [{jump: alpha_air, above: 0.2}, {jump: alpha_tissue, above: 0.2, finest: 1}]}
$materials
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 2e7}
  - {box: {lower: [0, 0.6], upper: [2, 2]}, material: tissue, density: 1000, pressure: 2e7, stretch: {xx: 1.1, yy: 0.9, zz: 1.1}}
  - {sphere: {center: [0, 0.35], radius: 0.2}, material: air, density: 1.2, pressure: 1e5}
run: {until: 1, max-steps: 40}
$output
END2

run() { # FOLDER CASE OPTIONS...: in a folder of its own, so that the outputs have the same names
    folder=$1 name=$2
    shift 2
    mkdir -p "$folder"
    cp "$name.yaml" "$folder"
    (cd "$folder" && "$BULLA" run "$name.yaml" --quiet "$@" </dev/null)
}

rm -rf one-* two-* three-* part-* fails-*
for name in plane round; do
    run one-$name $name -n 1
    run two-$name $name -n 2
    run three-$name $name -n 3
    run part-$name $name -n 3 --max-steps 11
    run part-$name $name -n 2 --restart
    for other in two three part; do
        cmp one-$name/out/history.csv $other-$name/out/history.csv
        for file in one-$name/out/fields/*.hdf; do
            if [ $other != part ]; then "$fields" $file $other-$name/out/fields/${file##*/}; fi
        done
    done
    last=$(cd one-$name/out/checkpoints && ls | tail -n 1)
    for other in two three part; do
        "$same" one-$name/out/checkpoints/$last $other-$name/out/checkpoints/$last
    done
    grep -q '"regrids": *[1-9]' one-$name/out/provenance.json || { echo "$name: levels do not move"; exit 1; }
done
"$BULLA" info one-plane/out/checkpoints/$(cd one-plane/out/checkpoints && ls | tail -n 1) >info
grep -q 'stretch_yz' info || { echo "a checkpoint does not name the stretch"; cat info; exit 1; }

# A step that fails, in tiles with and without the solid, is dumped and fails again to the bit.
for kind in plane round; do
    sed 's/^run:/scheme: {dt: 2}\nrun:/; s/max-steps: [0-9]*/max-steps: 2/' $kind.yaml >$kind-fails.yaml
    code=0
    run fails-$kind $kind-fails || code=$?
    [ $code = 3 ] || { echo "$kind-fails ends with $code"; exit 1; }
    "$BULLA" info --replay fails-$kind/out/dump_000001.h5 >info
    grep -q '^replay *0 of [0-9]* quantities at the faces of the cell differ, 0 of [0-9]* cells' info || { cat info; exit 1; }
done
"$BULLA" info fails-round/out/dump_000001.h5 >info
grep -q 'flux.stretch_yy' info || { echo "a dump does not show the stretch at faces"; cat info; exit 1; }
