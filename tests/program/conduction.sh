# Heat through channels: the same bits on 1, 2 and 3 ranks, on tiles of 4, 8 and 16, and after a restart, with levels; mass
# and energy to round-off; the plan shows the term; a scene without conductivity does not know of it.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >hot.yaml <<'END'
bulla: 1
title: A hot bubble in cold water
domain: {lower: [0, 0], upper: [32 um, 32 um], cells: [32, 32], boundaries: {x-: reflecting, x+: reflecting, y-: no-slip, y+: symmetry}}
mesh: {tile: 8, levels: 1, refine: [{interface: air, where: {box: {lower: [0, 0], upper: [16 um, 32 um]}}}]}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa, cv: 590}, conductivity: 0.607 W/m/K}
  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}, conductivity: 0.0262 W/m/K}
initial:
  - {everywhere: true, material: water, temperature: 300 K, pressure: 1 atm}
  - {sphere: {center: [15.3 um, 14.2 um], radius: 7 um}, material: air, temperature: 900 K, pressure: 1 atm}
scheme: {cfl: 0.4}
run: {until: 1 ms, max-steps: 30}
output:
  directory: out
  checkpoints: {every: 10 steps}
  history: {columns: {m: {mass: air}, M: {mass: water}, E: {total: energy}, p: {mean: pressure}, T: {max: temperature_air}}}
expect:
  - {value: "abs(last(m)/first(m) - 1)", at-most: 1e-12}
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-12}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-13}
END
ranked hot 1 2 3
resumed hot 10 hot-1

# One level: sums go tile by tile, but extremes do not know of tiles.
for tile in 4 8 16; do
    "$BULLA" run hot.yaml -o tile-$tile --set mesh.tile=$tile --set mesh.levels=0 \
        --set 'output.history={columns: {p: {max: pressure}, q: {min: pressure}, T: {max: temperature_air}, W: {min: temperature_water}}}' \
        --set 'expect=[]' --quiet
    cmp tile-4/history.csv tile-$tile/history.csv
done

"$BULLA" plan hot.yaml >plan
grep -q '^  conduction .*water constant, air constant .*core/scheme/conduction.c' plan || { cat plan; exit 1; }
"$BULLA" plan hot.yaml --set materials.water.conductivity=0 --set materials.air.conductivity=0 >without
! grep -q conduction without || { cat without; exit 1; }

# The gas cools.
"$BULLA" run hot.yaml -o cold --set materials.water.conductivity=0 --set materials.air.conductivity=0 --quiet
awk -F, 'FNR == 1 { for (i = 1; i <= NF; i++) if ($i == "p") c = i } { last[FILENAME] = $c }
    END { exit !(last["hot-1/out/history.csv"] < last["cold/history.csv"] - 1) }' hot-1/out/history.csv cold/history.csv

# What is wrong or doubtful is said with its line.
said() { # WORDS ARGS...
    words=$1
    shift
    "$BULLA" check hot.yaml "$@" >out 2>err || true
    grep -q "$words" err || { echo "not said: $words"; cat out err; exit 1; }
}
said "heat spreads 1.6 times as fast"
"$BULLA" check hot.yaml --set materials.water.conductivity=0.377 >out 2>&1
! grep -q "times as fast" out || { cat out; exit 1; }
said "'water' conducts heat, but its law stiffened-gas has no temperatures" \
    --set 'materials.water.eos={type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}'
said "with conduction volume must move with heat, which 'allaire' does not" --set scheme.closure=allaire
said "temperatures of interfaces come out wrong with 'fast'" --set scheme.exchange=fast
said "no material conducts heat, so the wall gives none" --set 'domain.boundaries.x-={type: reflecting, temperature: 300 K}' \
    --set 'materials.water={eos: {type: stiffened-gas, preset: sg44}}' --set 'materials.air={eos: {type: ideal-gas, gamma: 1.4}}'
said "a wall has a temperature or gives a flux of heat, not both" \
    --set 'domain.boundaries.x-={type: reflecting, temperature: 300 K, heat-flux: 1 W/m2}'
said "is outside 0 to" --set materials.water.conductivity=-1
"$BULLA" check hot.yaml >out 2>err
grep -q 'conducts 26.2 mW/m/K at 25 C and 1 atm, cp 1005 J/kg/K (air: 1006): diffusivity 2.2' out || { cat out; exit 1; }

# Walls: of a temperature that a script gives; a script that fails says where.
"$BULLA" run hot.yaml -o warm --set 'domain.boundaries.y-={type: no-slip, temperature: "= 300 + 1e10 * t"}' --set 'expect=[]' --quiet
"$BULLA" run hot.yaml -o same --set 'domain.boundaries.y-={type: no-slip, temperature: "= 300 + 1e10 * t"}' --set 'expect=[]' -n 2 --quiet
cmp warm/history.csv same/history.csv
if cmp -s warm/history.csv hot-1/out/history.csv; then echo "the wall does nothing"; exit 1; fi
code=0
"$BULLA" run hot.yaml -o broken --set 'domain.boundaries.y-={type: no-slip, temperature: "= t > 1e-10 and nil + 1 or 300"}' \
    --set 'expect=[]' --quiet 2>err || code=$?
[ "$code" = 3 ] || [ "$code" = 2 ] || { echo "code $code"; cat err; exit 1; }
grep -q 'heat of the wall at' err || { cat err; exit 1; }
