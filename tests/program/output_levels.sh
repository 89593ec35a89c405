# What a run of several levels writes does not depend on the ranks either, while its tiles come and go: histories, probes
# and snapshots are the same to the last bit. Every file says which levels it holds.
set -eu
same="$BULLA_BUILD/tests/test-unit-snapshot"
cat >cylinder.yaml <<'END'
bulla: 1
title: A shock in air meets a helium cylinder
domain:
  lower: [0, 0]
  upper: [267 mm, 44.5 mm]
  cells: [96, 16]
  boundaries: {x-: outflow, x+: outflow, y-: symmetry, y+: reflecting}
mesh: {levels: 2, tile: 8, regrid-every: 4, buffer: 4, refine: [{jump: density, above: 0.03}, {interface: helium}]}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  helium: {eos: {type: ideal-gas, gamma: 1.648}}
initial:
  - {everywhere: true, material: air, density: 1.225, pressure: 101325}
  - half-space: {normal: [1, 0], point: [225 mm, 0]}
    material: air
    density: 1.68605
    pressure: 159060
    velocity: [-113.524, 0]
  - {sphere: {center: [175 mm, 0], radius: 25 mm}, material: helium, density: 0.2228, pressure: 101325}
scheme: {cfl: 0.4}
run: {until: 1 ms, max-steps: 160}
output:
  snapshots:
    every: 80 steps
    precision: double
    fields: [density, velocity, pressure, alpha_helium, schlieren, vorticity, level]
  history:
    columns:
      V: {volume: helium}
      m: {mass: helium}
      x: {centroid: helium, along: x}
      pmax: {max: pressure, in: helium}
      p: {mean: pressure, where: {sphere: {center: [150 mm, 0], radius: 20 mm}}}
      total: {total: energy}
      jet: {jet-speed: helium, along: x}
      depth: {penetration: helium, along: x}
      skin: {isosurface-mean: pressure, in: helium}
  probes:
    edge: {at: [208 mm, 30 mm], fields: [pressure, velocity, level]}
END
run() # NAME OPTIONS...
{
    name=$1
    shift
    mkdir -p "$name"
    (cd "$name" && cp ../cylinder.yaml . &&
        ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" \
            "$BULLA" run cylinder.yaml -o out --quiet --overwrite "$@")
}
run alone
run two -n 2
run three -n 3
[ "$(wc -l <alone/out/history.csv)" -eq 162 ] || { echo "history.csv has not 161 rows"; exit 1; }
for ranks in two three; do
    cmp alone/out/history.csv "$ranks/out/history.csv"
    cmp alone/out/probes.csv "$ranks/out/probes.csv"
    for step in 000000 000080 000160; do
        "$same" "alone/out/fields/cylinder_$step.hdf" "$ranks/out/fields/cylinder_$step.hdf"
    done
done
[ "$(cut -d, -f6 alone/out/probes.csv | sort -u | grep -c '^[0-2]$')" -ge 2 ] ||
    { echo "the probe has not seen several levels"; exit 1; }
"$BULLA" info alone/out/fields/cylinder_000160.hdf | grep -q '^levels    3$'
for key in '"peak_cells"' '"regrids"' '"leaves"'; do grep -q "$key" alone/out/provenance.json; done
"$BULLA" plot alone/out density --tiles -o picture.png
[ -s picture.png ]
"$BULLA" report alone/out
grep -q 'level 2, cells of' alone/out/report.html
