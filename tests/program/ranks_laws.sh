# Real fluids beside a law in closed form and a solid, on levels of refinement: the bits are the same on 1, 2 and 3 ranks,
# and after a stop, from a checkpoint, on other ranks.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
same="$BULLA_BUILD/tests/test-unit-snapshot"
again="$BULLA_BUILD/tests/test-unit-checkpoint"

cat >laws.yaml <<'END'
bulla: 1
title: A wave, a bubble of RKPR air, real water, a gel
domain:
  geometry: axisymmetric
  lower: [0, -3 mm]
  upper: [1 mm, 1 mm]
  cells: [24, 96]
  boundaries:
    x-: axis
    x+: outflow
    y-: outflow
    y+: {type: incoming-wave, pulse: sine, amplitude: 20 MPa, frequency: 2 MHz}
mesh: {tile: 8, levels: 1, refine: [{interface: air}], regrid-every: 3}
materials:
  water: {eos: {type: iapws95}}
  air: {eos: {type: rkpr, eval: table}}
  gel: {eos: {type: mnasg, preset: water}, constitutive: {type: neo-hookean, shear-modulus: 50 kPa, reference-density: 1000}}
initial:
  - {everywhere: true, material: water, temperature: 300 K, pressure: 1 bar}
  - {box: {lower: [0.7 mm, -0.4 mm], upper: [1 mm, 0.4 mm]}, material: water, temperature: 275 K, pressure: 1 bar}
  - {half-space: {point: [0, 0.6 mm], normal: [0, 1]}, material: water, temperature: 300 K, pressure: 100 bar}
  - {half-space: {point: [0, -0.5 mm], normal: [0, -1]}, material: gel, temperature: 300 K, pressure: 1 bar}
  - {sphere: {center: [0, 0.1 mm], radius: 0.3 mm}, material: air, temperature: 300 K, pressure: 1 bar}
scheme: {cfl: 0.4}
run: {until: 1 us, max-steps: 24}
output:
  snapshots: {every: 24 steps, fields: [density, velocity, pressure, temperature, alpha_air], precision: double}
  checkpoints: {every: 12 steps, keep: 3}
  history: {every: 3 steps, columns: {V: {volume: air}, pmax: {max: pressure}, E: {total: energy}, cold: {outside: water}, most: {outside: air}}}
END

run() { # FOLDER [OPTIONS]
    folder=$1
    shift
    mkdir -p "$folder"
    cp laws.yaml "$folder"
    (cd "$folder" && "$BULLA" run laws.yaml -o out --quiet "$@" 2>err)
}
facts() { sed -n '/"closures"/,/"levels"/p' "$1/out/provenance.json"; }
compare() {
    cmp one/out/history.csv "$1/out/history.csv"
    "$same" one/out/fields/laws_000024.hdf "$1/out/fields/laws_000024.hdf"
    "$again" one/out/checkpoints/laws_000024.chk "$1/out/checkpoints/laws_000024.chk"
}

rm -rf one two three part
run one -n 1
run two -n 2
run three -n 3
run part -n 2 --max-steps 12
run part -n 3 --restart
for folder in two three part; do compare $folder; done

# Water at 275 K lies below the domain of IAPWS-95. Every step counts its cells: the column of a history of every step adds
# up to what the provenance and the warning at the end say.
run every --set output.history.every='1 steps'
for folder in two three part every; do
    facts $folder | sed -n '/"outside"/,$p' >$folder/facts
    facts one | sed -n '/"outside"/,$p' | cmp - $folder/facts
done
"${python3:-python3}" - <<'END'
import csv, json
rows = list(csv.DictReader(open("every/out/history.csv")))[1:]
facts = json.load(open("every/out/provenance.json"))
cold = [int(float(row["cold"])) for row in rows]
assert len(rows) == 24 and min(cold) > 10, cold
assert facts["outside"]["water"] == {"cell_steps": sum(cold), "most_cells": max(cold)}, facts["outside"]
assert facts["outside"]["gel"] == {"cell_steps": 0, "most_cells": 0}, facts["outside"]
closures = facts["closures"]
assert closures["solved"] > 1000 and 0 < closures["mean_steps"] < 3 and closures["most_steps"] < 10, closures
said = open("every/err").read()
assert f"material 'water' left its law in {sum(cold)} cell-steps ({max(cold)} cells at most)" in said, said
assert "'iapws95' is stated for 640 to 1240 kg/m3, 1 kPa to 1 GPa, 281 to 1273 K" in said, said
assert "'gel' left" not in said, said
END
grep -q '"cells_carried": *[1-9]' one/out/provenance.json || { echo "nothing rested"; exit 1; }
