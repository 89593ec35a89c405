# Nobody reads tiles that sleep (core/mesh/doze.h) before he has woken them: the program whose sleeping tiles are poisoned
# (tests/asleep), with NaN and with numbers, gives the bits of the program: histories, probes, snapshots, checkpoints, what
# the guard did; on 1, 2 and, at night, 3 ranks, stopped and continued, with few checkpoints and with many. The insides of
# the scenes are refined, so that their coarser tiles sleep at several depths: a bubble and a pulse in the plane, with
# columns and probes of all kinds; in space; laws whose pressure is iterated, with surface tension; a solid round an axis.
# With super steps of what diffuses none sleeps: they look at all tiles.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
same="$BULLA_BUILD/tests/test-unit-checkpoint"
program=$BULLA poisoned="$BULLA_BUILD/tests/bulla-asleep"

fluids='materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}'
inside='{value: alpha_air, above: 0.01}'
still='initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1e5}'
output='output:
  snapshots: {every: 4 steps, fields: [density, velocity, pressure, schlieren, max_pressure, vorticity, level], precision: double}
  checkpoints: {every: 3 steps, keep: 9}'

cat >plane.yaml <<END2
bulla: 1
title: A bubble and a pulse in the plane
domain: {lower: [0, 0], upper: [1, 1], cells: [64, 64], boundaries: {x-: periodic, x+: periodic, y-: reflecting, y+: non-reflecting}}
mesh: {tile: 8, levels: 3, regrid-every: 3, buffer: 3, patience: 1, refine: [$inside, {jump: pressure, above: 0.2, finest: 2}]}
$fluids
$still
  - {half-space: {point: [0, 0.8], normal: [0, 1]}, material: water, density: 1020, pressure: 1e8, velocity: [30, -90]}
  - {sphere: {center: [0.5, 0.45], radius: 0.33}, material: air, density: 1.2, pressure: 1e5}
run: {until: 1, max-steps: 8}
$output
  history:
    every: 1 steps
    columns: {V: {volume: air}, depth: {penetration: air, along: y}, R: {equivalent-radius: air}, p: {max: pressure}, E: {total: energy}, s: {max: schlieren}}
  probes: {every: 1 steps, in: {at: [0.5, 0.45], fields: [pressure, velocity]}, out: {at: [0.5, 0.79], fields: [pressure]}}
END2
cat >space.yaml <<END2
bulla: 1
title: A bubble in space
domain: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [24, 24, 24], boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic, z-: outflow, z+: outflow}}
mesh: {tile: 4, levels: 1, regrid-every: 2, buffer: 2, refine: [{value: alpha_air, above: 0.01}]}
$fluids
$still
  - {sphere: {center: [0.5, 0.5, 0.5], radius: 0.42}, material: air, density: 50, pressure: 1e7}
run: {until: 1, max-steps: 5}
$output
  history: {columns: {V: {volume: air}, p: {max: pressure}}}
END2
cat >tense.yaml <<END2
bulla: 1
title: A drop with laws that are iterated
domain: {lower: [0, 0], upper: [1 mm, 1 mm], cells: [48, 48], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}
mesh: {tile: 8, levels: 2, regrid-every: 4, buffer: 4, refine: [{value: alpha_water, above: 0.01}]}
materials:
  water: {eos: {type: modified-tait, preset: refit}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
surface-tension: {water+air: 0.07}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5, velocity: [30, 0]}
  - {sphere: {center: [0.5 mm, 0.5 mm], radius: 0.35 mm}, material: water, density: 1000, pressure: 1.2e5}
run: {until: 1, max-steps: 8}
$output
  history: {columns: {V: {volume: water}, k: {isosurface-mean: curvature_water, in: water}, p: {max: pressure}}}
END2
cat >round.yaml <<END2
bulla: 1
title: A blast in a solid round an axis
domain: {geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [48, 48], boundaries: {x-: axis, x+: outflow, y-: outflow, y+: outflow}}
mesh: {tile: 8, levels: 2, regrid-every: 2, buffer: 3, patience: 1, refine: [{value: alpha_tissue, above: 0.01}]}
$fluids
  tissue:
    eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}
    constitutive: {type: neo-hookean, shear-modulus: 50 MPa, reference-density: 1000}
$still
  - {sphere: {center: [0, 0.5], radius: 0.4}, material: tissue, density: 1000, pressure: 1e5}
  - {sphere: {center: [0, 0.5], radius: 0.1}, material: tissue, density: 1100, pressure: 3e8}
run: {until: 1, max-steps: 8}
$output
  history: {columns: {m: {mass: tissue}, p: {max: pressure}}}
END2
equal() { # FOLDER FOLDER: outputs and checkpoints
    alike "$1" "$2"
    for file in "$1"/out/checkpoints/*.chk; do "$same" "$file" "$2/out/checkpoints/${file##*/}"; done
}
poison() { # CASE NUMBER RANKS: like the program on as many ranks, and some tiles were poisoned
    BULLA=$poisoned BULLA_POISON=$2
    export BULLA_POISON
    rm -rf "$1-poisoned"
    ran "$1-poisoned" "$1" -n "$3" 2>"$1-words" || fail "$1, $2 on $3 ranks ends" "$1-words"
    BULLA=$program
    grep -q 'poisoned [1-9]' "$1-words" || fail "nothing sleeps in $1" "$1-words"
    equal "$1-$3" "$1-poisoned"
}

for name in plane space tense round; do
    ranked "$name" 1 2
    poison "$name" nan 2
    [ -z "${BULLA_WHOLE:-}" ] || poison "$name" 1e9 1
done
poison plane 1e9 1
if [ -n "${BULLA_WHOLE:-}" ]; then
    ranked plane 1 3
    poison plane nan 3
fi
BULLA=$poisoned
ran awake plane --set scheme.diffusion=rkl2 2>words
BULLA=$program
! grep poisoned words
grep -q '"regrids": *[1-9]' plane-1/out/provenance.json || fail "no regrids"

# How often a run is saved does not move its numbers, nor where it is stopped.
for name in plane ${BULLA_WHOLE:+tense}; do
    rm -rf "$name-rare"
    ran "$name-rare" "$name" --set 'output.checkpoints={every: 8 steps, keep: 9}'
    cmp "$name-1/out/history.csv" "$name-rare/out/history.csv"
    last=$(cd "$name-rare/out/checkpoints" && ls | tail -n 1)
    "$same" "$name-1/out/checkpoints/$last" "$name-rare/out/checkpoints/$last" 2>words || true
    ! grep -v "^[a-z]\|notes" words || fail "$name: rare checkpoints differ" words
    resumed "$name" 5 "$name-1"
done
