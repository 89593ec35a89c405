# What a run writes does not depend on the ranks: histories, probes and the numbers of snapshots are the same on
# one process without MPI and on 1, 2 and 3 ranks.
set -eu
same="$BULLA_BUILD/tests/test-unit-snapshot"
cat >bubble.yaml <<'END'
bulla: 1
title: A shock meets a bubble
domain:
  geometry: axisymmetric
  lower: [0, -1 mm]
  upper: [1 mm, 1 mm]
  cells: [24, 48]
  boundaries: {x-: axis, x+: outflow, y-: reflecting, y+: outflow}
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
  snapshots: {every: 20 steps, fields: [density, velocity, pressure, temperature, alpha_air, schlieren, vorticity]}
  history:
    columns:
      V: {volume: air}
      m: {mass: water}
      z: {centroid: air}
      pmax: {max: pressure, in: water}
      p: {mean: pressure, where: {sphere: {center: [0, 0.6 mm], radius: 0.3 mm}}}
      total: {total: energy}
      pz: {total: momentum_y}
      jet: {jet-speed: air}
      depth: {penetration: air}
      skin: {isosurface-mean: pressure, in: air}
      R: {equivalent-radius: air}
      ratio: {value: V / m + t}
  probes:
    every: 7 ns
    top: {at: [0.333 mm, 0.333 mm], fields: [pressure, velocity]}
    wall: {at: [0, -1 mm], fields: [pressure]}
END
run()
{
    mkdir -p "$1"
    # Open MPI leaks by itself: the leak checker of a sanitized build would only see that
    (cd "$1" && cp ../bubble.yaml . &&
        ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" \
            "$BULLA" run bubble.yaml -o out -n "$2" --quiet --overwrite)
}
rm -rf alone one two three
mkdir -p alone
(cd alone && cp ../bubble.yaml . && "$BULLA" run bubble.yaml -o out --quiet --overwrite)
run two 2
run three 3
[ "$(wc -l <alone/out/history.csv)" -eq 42 ] || { echo "history.csv has not 41 rows"; exit 1; }
for ranks in two three; do
    cmp alone/out/history.csv "$ranks/out/history.csv"
    cmp alone/out/probes.csv "$ranks/out/probes.csv"
    cmp alone/out/fields/bubble.hdf.series "$ranks/out/fields/bubble.hdf.series"
    for step in 000000 000020 000040; do
        "$same" "alone/out/fields/bubble_$step.hdf" "$ranks/out/fields/bubble_$step.hdf"
    done
done
if "$same" alone/out/fields/bubble_000020.hdf alone/out/fields/bubble_000040.hdf 2>/dev/null; then
    echo "the comparison finds no difference between two steps"
    exit 1
fi
if ls alone/out/fields/*.tmp two/out/fields/*.tmp 2>/dev/null; then
    echo "temporary files are left"
    exit 1
fi
