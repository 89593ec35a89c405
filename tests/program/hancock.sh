# Hancock's first stage (scheme/hancock.h) in runs: the same bits on 1, 2 and 3 ranks, on tiles of 8, 16 and 32 and after a
# restart, with levels, curved geometry, two and three fluids and repaired cells; mass and energy to round-off; resting tiles are
# skipped; layers rest under gravity; smooth waves; half of the closures are saved; a strong jump at a surface does not go wrong; dumps replay;
# scenes that it knows nothing of are refused.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >jet.yaml <<'END'
bulla: 1
title: A wave meets a bubble below oil
domain:
  geometry: axisymmetric
  lower: [0, -1 mm]
  upper: [1 mm, 1 mm]
  cells: [16, 32]
  boundaries: {x-: axis, x+: reflecting, y-: reflecting, y+: reflecting}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  oil: {eos: {type: stiffened-gas, gamma: 4.1, p-inf: 400 MPa}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1 bar}
  - {half-space: {point: [0, 0.6 mm], normal: [0, 1]}, material: oil, density: 910, pressure: 300 bar}
  - {sphere: {center: [0, 0], radius: 0.4 mm}, material: air, density: 1.2, pressure: 1 bar}
mesh: {tile: 8, levels: 1, refine: [{interface: air}, {jump: pressure, above: 1 MPa}]}
scheme: {integrator: hancock, cfl: 0.8}
run: {until: 1 us, max-steps: 36}
output:
  directory: out
  snapshots: {every: 36 steps, fields: [density, velocity, pressure, alpha_air], precision: double}
  checkpoints: {every: 20 steps, keep: 3}
  history: {every: 1 step, columns: {V: {volume: air}, m: {mass: air}, M: {mass: water}, E: {total: energy}, p: {max: pressure}}}
expect:
  - {value: "abs(last(m)/first(m) - 1)", at-most: 1e-12}
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-12}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-12}
END
ranked jet 1 2 3
resumed jet 20 jet-1
"$BULLA_BUILD/tests/test-unit-snapshot" jet-1/out/fields/jet_000036.hdf jet-resumed/out/fields/jet_000036.hdf

# Tiles of any size: some hold one material with one size and two with another. Extremes know no order of summation.
sed -e 's/^mesh:.*/mesh: {tile: 8}/; s/cells: .*/cells: [32, 64]/; /checkpoints/d; /snapshots/d; /^expect/,$d' \
    -e 's/history:.*/history: {every: 1 step, columns: {p: {max: pressure}, q: {min: pressure}, r: {min: density}, R: {max: density}, u: {max: velocity_x}, v: {min: velocity_y}, w: {max: velocity_y}}}/' jet.yaml >tiles.yaml
for n in 8 16 32; do "$BULLA" run tiles.yaml --set mesh.tile=$n -o tiles-$n --quiet; done
for n in 16 32; do cmp tiles-8/history.csv tiles-$n/history.csv; done

# Nothing moves where nothing happens, and all of it is skipped; beside a wave most of it.
resting hancock 12 >rest.yaml
"$BULLA" run rest.yaml -o rest --quiet
grep -q '"cells_carried": *24576' rest/provenance.json || fail "not all of 12 steps of 2 stages of 1024 cells were carried on"
sed 's/^initial.*/initial: [{everywhere: true, material: water, density: 1000, pressure: 1 bar}, {half-space: {normal: [-1, 0], point: [0.06, 0]}, material: water, density: 1000, pressure: 2 bar}]/; /^expect/d; s/max-steps: 12/max-steps: 14/' rest.yaml >wave.yaml
for i in midpoint hancock; do "$BULLA" run wave.yaml --set scheme.integrator=$i -o wave-$i --quiet; done
carried() { sed -n 's/ *"cells_carried": *\([0-9]*\),*/\1/p' "$1/provenance.json"; }
[ "$(carried wave-hancock)" -ge "$(carried wave-midpoint)" ] || fail "resting tiles were computed"

# Layers rest under gravity: slopes of pressure and forces cancel.
"$BULLA" run "$BULLA_SOURCE/cases/verify/g1-column.yaml" --variant quick --set scheme.integrator=hancock -o column --quiet

# Streams that part: cells are marked, steps repeated; the same on any number of ranks.
{ parting 'integrator: hancock' 24; cat <<'END'; } >parting.yaml
output:
  history: {columns: {m: {mass: air}, E: {total: energy}, pmin: {min: pressure}}}
END
ranked parting 1 2 3
grep -q '"relaxed": *[1-9]' parting-1/guard || fail "nothing was repaired"

# Laws that take an iteration: it is done once a step.
sed 's/{type: ideal-gas, gamma: 1.4}/{type: rkpr, eval: table}/; s/density: 1.2,/density: 1.225,/' tiles.yaml >dear.yaml
for i in midpoint hancock; do "$BULLA" run dear.yaml --set scheme.integrator=$i --set run.max-steps=60 -o dear-$i --quiet; done
closures() { sed -n '/"closures"/,/}/p' "$1/provenance.json" | sed -n 's/ *"solved": *\([0-9]*\),*/\1/p'; }
[ "$(closures dear-midpoint)" -gt 0 ] || fail "no law is iterated"
[ $((10 * $(closures dear-hancock))) -lt $((6 * $(closures dear-midpoint))) ] || fail "closures were not saved"

# Smooth flow: second order with the bounds that the midpoint rule has.
for scene in a3-acoustic-gas a3-entropy; do
    "$BULLA" run "$BULLA_SOURCE/cases/verify/$scene.yaml" --set scheme.integrator=hancock -o $scene --quiet
done

# Around a centre: R(t) of a collapse as near to the truth as with the midpoint rule (0.0184).
"$BULLA" run "$BULLA_SOURCE/cases/verify/a4-collapse-353.yaml" --set scheme.integrator=hancock -o collapse --quiet \
    --set "expect=[{norm: L1, field: R_over_R0, reference: $BULLA_SOURCE/cases/verify/reference/collapse-353.csv, column: R/R0, at-most: 0.0185}]" \
    --set 'domain.cells=[1024]'

# With long steps around a centre it needs the damping of the faces (docs/decisions/low-mach.md), else it has none by itself.
slow() { "$BULLA" show "$BULLA_SOURCE/cases/verify/a4-collapse-20.yaml" --set scheme.integrator=$1 --set scheme.cfl=$2 | grep -c 'low-mach: 0.05' || true; }
[ "$(slow hancock 0.4)$(slow hancock 0.8)$(slow midpoint 0.8)" = 101 ] || fail "low-mach of hancock"

# Without the first steps of the midpoint rule the air of this tube has 20 m/s too much (docs/decisions/hancock.md).
"$BULLA" run "$BULLA_SOURCE/cases/verify/r07.yaml" --set scheme.integrator=hancock --set 'domain.cells=[250]' -o tube --quiet \
    --set 'expect=[{norm: L1, field: velocity_x, reference: exact-riemann, at-most: 4.2}]'

# A step that fails for good leaves a dump that replays to the bit.
code=0
"$BULLA" run parting.yaml --set scheme.guard=strict --set scheme.dt='60 us' -o strict --quiet 2>err || code=$?
[ "$code" = 3 ] || fail "exit code $code" err
"$BULLA" info --replay strict/dump_*.h5 >info 2>&1 || fail "the replay gives something else" info err
grep -q 'to the bit' info || fail "the replay differs" info

# What it knows nothing of is refused before the run.
without() { # WORDS SETTING...
    without_words=$1
    shift
    "$BULLA" check wave.yaml --set scheme.integrator=hancock "$@" >out 2>&1 && fail "not refused: $*"
    grep -q "scheme.integrator: 'hancock' does not go with $without_words" out || fail "no '$without_words' in:" out
}
without viscosity --set 'materials.water.viscosity=1 mPa s'
without 'conduction of heat' --set 'materials.water.conductivity=0.6 W/m/K' --set 'materials.water.eos.cv=3000'
without sources --set 'sources={heating: 1 kW/m3}'
without solids --set 'materials.water.constitutive={type: neo-hookean, shear-modulus: 1 MPa, reference-density: 1000}'
without "'closure: allaire'" --set scheme.closure=allaire --set 'materials.air={eos: {type: ideal-gas, gamma: 1.4}}'
"$BULLA" check wave.yaml --set scheme.integrator=hancock --set 'sources={acceleration: [0, -9.81 m/s2]}' >out 2>&1 || fail "refused" out
