# Waves under an angle and from transducers: the pressure at points of the domain is that of the plane and of the converging
# wave, from faces that the wave meets, leaves and runs along; windows of bursts; what makes no sense is refused.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cat >plane.yaml <<'CASE'
bulla: 1
title: A plane wave under an angle
domain:
  lower: [0, 0]
  upper: [4 mm, 4 mm]
  cells: [64, 64]
  boundaries:
    x-: &wave {type: incoming-wave, pulse: sine, amplitude: 10 kPa, frequency: 0.75 MHz, cycles: 1, window: hann, direction: {along: [2, 1]}}
    x+: *wave
    y-: *wave
    y+: *wave
mesh: {tile: 16}
materials: {water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}}
initial: [{everywhere: true, material: water, density: 998, pressure: 1 bar}]
scheme: {cfl: 0.4} # probes see every step
run: {until: 4.4 us}
output:
  directory: out
  probes: {every: 1 step, a: {at: [2 mm, 2 mm], fields: [pressure]}, b: {at: [1 mm, 3 mm], fields: [pressure]}, c: {at: [3 mm, 0.5 mm], fields: [pressure]}}
CASE
cat >focus.yaml <<'CASE'
extends: plane.yaml
title: A wave to a focus
domain:
  geometry: axisymmetric
  lower: [0, -3 mm]
  upper: [3 mm, 3 mm]
  cells: [48, 96]
  boundaries:
    x-: axis
    x+: &wave {type: incoming-wave, pulse: sine, amplitude: 10 kPa, frequency: 0.75 MHz, cycles: 1, window: hann, direction: null, focus: {at: [0, 0], radius: 5 mm}}
    y-: *wave
    y+: *wave
run: {until: 3.9 us}
output: {probes: {a: {at: [1 mm, 0]}, b: {at: [0, 2 mm]}, c: {at: [1.2 mm, -1.6 mm]}}}
CASE
cat >near.awk <<'AWK'
# The largest difference from the wave over its largest value, at three points.
function pulse(t,   s, e) { s = t * 0.75e6; if (s < 0 || s > 1) return 0; e = s < 1 - s ? s : 1 - s; return 1e4 * sin(2 * pi * s) * 0.5 * (1 - cos(2 * pi * e)) }
function plane(k, t) { return pulse(t - (2 * x[k] + y[k]) / sqrt(5) / c) }
function focus(k, t,   r) { r = sqrt(x[k]^2 + y[k]^2); return 5e-3 / r * (pulse(t - (5e-3 - r) / c) - pulse(t - (5e-3 + r) / c)) }
BEGIN { FS = ","; pi = atan2(0, -1); c = sqrt(4.4 * (1e5 + 6e8) / 998); split(place, q, " "); for (k = 1; k <= 3; k++) { x[k] = q[2 * k - 1]; y[k] = q[2 * k] } }
/^#/ || /^t/ { next }
{ for (k = 1; k <= 3; k++) { e = way == "plane" ? plane(k, $1) : focus(k, $1); d = $(k + 1) - 1e5 - e; if (d < 0) d = -d; if (d > off[k]) off[k] = d; if (e > top[k]) top[k] = e } }
END { for (k = 1; k <= 3; k++) { print way, k, off[k] / top[k]; if (!(off[k] < within * top[k])) exit 1 } }
AWK
ranked plane 1 2
awk -v way=plane -v within=0.09 -v place="2e-3 2e-3 1e-3 3e-3 3e-3 0.5e-3" -f near.awk plane-1/out/probes.csv
"$BULLA" run focus.yaml -o focused --quiet
awk -v way=focus -v within=0.07 -v place="1e-3 0 0 2e-3 1.2e-3 -1.6e-3" -f near.awk focused/probes.csv

# Out of the aperture nothing comes in: at rest until the edge's wave is there, 1.7 mm later.
"$BULLA" run plane.yaml -o narrow --quiet --set 'domain.boundaries={x-: {type: incoming-wave, pulse: sine, amplitude: 10 kPa, frequency: 1 MHz, cycles: 2, window: tukey, focus: {at: [4 mm, 0], radius: 4 mm, aperture: 20 deg}}, x+: non-reflecting, y-: symmetry, y+: non-reflecting}' \
    --set run.until='1 us' --set 'output.probes={a: {at: [0.1 mm, 0.5 mm], fields: [pressure]}, b: {at: [0.1 mm, 3.2 mm], fields: [pressure]}}'
awk -F, '!/^#/ && !/^t/ { a = $2 > a ? $2 : a; d = $3 - 1e5; b = d > b ? d : -d > b ? -d : b } END { if (!(a > 108000 && b < 10)) { print a, b; exit 1 } }' narrow/probes.csv

refused() { # CASE SETTING WORDS
    code=0
    "$BULLA" check "$1.yaml" --set "$2" >said 2>&1 || code=$?
    [ "$code" = 2 ] && grep -qF -- "$3" said || fail "exit $code, and nothing of '$3'" said
}
refused plane 'domain.boundaries.x-.focus={at: [0, 0], radius: 5 mm}' 'a direction or a focus, not both'
refused plane 'domain.boundaries.x-.direction.along=[0, 0]' 'a direction is needed'
refused plane 'domain.boundaries.x-.direction.along=[1, 0, 0]' '2 numbers are needed'
refused plane 'domain.boundaries.x-.cycles=0' 'a wave that never ends has no window'
refused focus 'domain.boundaries.x+.focus.at=[1 mm, 0]' 'not one around an axis'
refused plane 'initial=[{lua: "function(x, y, z) return {density = 998, pressure = 1e5} end"}]' 'speed of sound at this face is not known'
"$BULLA" check plane.yaml --set 'initial=[{lua: "function(x, y, z) return {density = 998, pressure = 1e5} end"}]' \
    --set 'domain.boundaries.x-.sound-speed=1.6 km/s' --set 'domain.boundaries.x+.sound-speed=1.6 km/s' \
    --set 'domain.boundaries.y-.sound-speed=1.6 km/s' --set 'domain.boundaries.y+.sound-speed=1.6 km/s' >said
