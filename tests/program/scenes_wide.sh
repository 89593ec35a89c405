# More scenes that nobody would write (scenes.sh), each of which has once shown a fault. 508: steps that only the guard's
# last try bears. 613 to 976: weight behind walls, surfaces of tiles that change hands at the start, and cells that went by what
# their path knows. From 1000 on: walls to which solids stick, retries, matter that also moves across the plane, heat from walls,
# and, 1580, super steps beside a finer level. From 2000 on: volume without mass, gases alone in a tile, hot traces of vapour,
# masses that no cell holds, and, 3324, what lies behind coarser faces, forgotten when finer levels change.
# 3612: what an array held before, in fields that carry nothing. Then a ball that moves where fluids meet.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

quick=-q
[ -z "${BULLA_WHOLE:-}" ] || quick=
# shellcheck disable=SC2086
PYTHONDONTWRITEBYTECODE=1 "${python3:-python3}" "$BULLA_SOURCE/tests/scenes/hunt.py" \
    -s $quick 508 613 615 694 976 1010 1097 1162 1165 1211 1251 2105 || fail "see above"

# The first steps of larger ones.
drawn() { # SEED: writes scene-SEED.yaml
    PYTHONDONTWRITEBYTECODE=1 "${python3:-python3}" -c 'import json, sys; sys.path.insert(0, sys.argv[1]); import draw
print(json.dumps(draw.draw(int(sys.argv[2]))[0]))' "$BULLA_SOURCE/tests/scenes" "$1" >"scene-$1.yaml"
}
for seed in 1580 2044 2139 2632 3324 3612 4110; do drawn $seed; done
snapshots='output.snapshots={every: 1 steps, fields: [pressure, velocity], precision: double}'
for ranks in 1 2; do ran "edge-$ranks" scene-1580 --max-steps 1 --set "$snapshots" -n $ranks; done
alike edge-1 edge-2
for ranks in 1 2; do ran "behind-$ranks" scene-3324 --max-steps 4 --set "$snapshots" -n $ranks; done
alike behind-1 behind-2
for ranks in 1 3; do ran "lies-$ranks" scene-3612 --set scheme.interface-along=normal -n $ranks; done
alike lies-1 lies-3
last=out/checkpoints/scene-3612_000048.chk
"$BULLA_BUILD/tests/test-unit-checkpoint" "lies-1/$last" "lies-3/$last" >said 2>&1 || fail "fields that carry nothing" said
ran thin scene-2044 --max-steps 4
ran hot scene-2139 --max-steps 2
ran debt scene-2632 --max-steps 5
ran owes scene-4110 --max-steps 20
# Refluxing looks for troubled cells where the guard may repair nothing, too.
code=0
ran strict scene-2139 --set scheme.guard=strict --max-steps 2 2>err || code=$?
case $code in 0 | 3) ;; *) fail "exit code $code" err ;; esac

# What the wall's cell holds, the cell beside it may not have: -1e-5 kg/m3 of air in the first step.
cat >ball.yaml <<'END_BALL'
bulla: 1
title: A ball through the surface of a bubble
domain:
  lower: [0, 0]
  upper: [8.9 mm, 8.9 mm]
  cells: [32, 32]
  boundaries: {x-: symmetry, x+: symmetry, y-: symmetry, y+: reflecting}
mesh: {tile: 8}
materials:
  water: {eos: {type: stiffened-gas, preset: glycerol}}
  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}}
bodies: {rock: {sphere: {center: [4.45 mm, 4.45 mm], radius: 1.34 mm}, velocity: [50, 0]}}
scheme: {riemann: hlld, limiter: superbee, closure: allaire, reconstruction: weno5-z}
initial:
  - {everywhere: true, material: water, temperature: 300, pressure: 4.8 MPa}
  - sphere: {center: [6.93 mm, 5.69 mm], radius: 2.91 mm}
    fractions: {water: 0.089, air: 0.911}
    temperature: 300
    pressure: 2.4 MPa
run: {until: 10 us, max-steps: 40}
output: {history: {every: 1 steps, columns: {m: {mass: air}, u: {max: "= math.sqrt(velocity_x^2 + velocity_y^2)"}}}}
expect:
  - {value: "max(u)", label: "fastest, m/s", at-most: 100} # 36 m/s
END_BALL
limited "$BULLA" run ball.yaml --quiet -n 1 2>err || fail "a ball through the surface of a bubble" err
