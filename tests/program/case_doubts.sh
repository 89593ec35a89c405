# What runs, but is probably not what was meant: `check` says it before the run, with file, line, column and the numbers,
# and does not change its exit code. Beside every doubt stands the same case without it, which is silent.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cat >base.yaml <<'END'
bulla: 1
title: A bubble in front of a wall
domain:
  geometry: axisymmetric
  lower: [0, 0]
  upper: [250 um, 500 um]
  cells: [40, 80]
  boundaries:
    x+: outflow
    y-: reflecting
    y+: {type: incoming-wave, pulse: sine, amplitude: 1 MPa, frequency: 20 MHz, delay: 10 ns}
materials:
  water: {eos: {type: stiffened-gas, preset: sg44}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: water, density: 998.2, pressure: 1 atm}
  - {sphere: {center: [0, 100 um], radius: 50 um}, material: air, density: 1.225, pressure: 1 atm}
run: {until: 100 ns}
output:
  snapshots: {every: 20 ns}
  history: {columns: {V: {volume: air}, p: {max: pressure, where: {box: {lower: [0, 0], upper: [10 um, 10 um]}}}}}
END
silent() { # ARGS...: no warning
    "$BULLA" show "$@" >shown 2>said || { echo "refused: $*"; cat said; exit 1; }
    [ ! -s said ] || { echo "a false alarm: $*"; cat said; exit 1; }
}
doubt() { # LINE:COLUMN PATTERN ARGS...: one warning, at that place of base.yaml ("-": of a setting), and what it says
    place=$1 pattern=$2
    shift 2
    "$BULLA" show "$@" >shown 2>said || { echo "refused: $*"; cat said; exit 1; }
    if [ "$(grep -c ': warning: ' said)" != 1 ] || ! grep -qF -- "$pattern" said; then
        echo "not one warning with '$pattern': $*"
        cat said
        exit 1
    fi
    [ "$place" = - ] || grep -q "^base.yaml:$place: warning: " said || { echo "not at $place: $*"; cat said; exit 1; }
}
changed() { sed "$1" base.yaml >changed.yaml && mv changed.yaml base.yaml; } # SCRIPT OF sed
silent base.yaml
cp base.yaml right.yaml

# Waves: cells per wave length where they come in, on the level that a criterion puts there.
wave='domain.boundaries.y+'
changed 's/20 MHz/40 MHz/'
doubt 11:38 'a wave length is 4.07e-05 m here (at 1626 m/s) and has 6.5 cells of 6.25e-06 m, those of level 0' base.yaml
grep -q 'a wave needs 8: smaller cells along y' said
silent base.yaml --set mesh.levels=1 --set 'mesh.refine=[{jump: pressure, above: 10 kPa}]'
doubt 11:38 'those of level 0' base.yaml --set mesh.levels=1 --set 'mesh.refine=[{interface: air}]'
doubt 11:38 'those of level 0' base.yaml --set mesh.levels=1 \
    --set 'mesh.refine=[{jump: pressure, above: 10 kPa, where: {box: {lower: [0, 0], upper: [1, 300 um]}}}]'
cp right.yaml base.yaml
changed 's/pulse: sine.*/pulse: gaussian, amplitude: 1 MPa, center: 20 ns, width: 4 ns}/'
doubt 11:38 'has 5.2 cells' base.yaml
silent base.yaml --set "$wave.width=8 ns"
changed '11s/center.*/center: 20 ms, width: 8 ms}/'
doubt 11:38 'this pulse lasts 0.016 s, but the run only 1e-07 s' base.yaml
cp right.yaml base.yaml
printf 't,p\n0,0\n20,2\n40,0\n150,0\n' >pulse.csv
changed 's/pulse: sine.*/pulse: series, file: pulse.csv}/'
doubt 11:38 'this pulse lasts 150 s, but the run only 1e-07 s' base.yaml
grep -q "are the times in another unit? 'units: {t: us, p: MPa}'" said
silent base.yaml --set "$wave.units=[ns, MPa]"
doubt 11:38 'this pulse lasts 1.5e-13 s, but a time step about' base.yaml --set "$wave.units=[fs, MPa]"
doubt 11:38 'has 7.8 cells' base.yaml --set "$wave.units.t=ns" --set 'domain.cells=[20, 40]'
cp right.yaml base.yaml
changed 's/delay: 10 ns/delay: 10 us/'
doubt 11:88 'the run ends before that, at 1e-07 s: the wave does not come in' base.yaml

# Bubbles: cells per radius on the finest level that the criteria put there.
cp right.yaml base.yaml
changed 's/radius: 50 um/radius: 20 um/'
doubt 17:14 'a radius of 2e-05 m has 3.2 cells of 6.25e-06 m, those of level 0' base.yaml
silent base.yaml --set mesh.levels=1 --set 'mesh.refine=[{interface: air}]'
doubt 17:14 "no criterion of 'mesh.refine' puts the finest level there" base.yaml --set mesh.levels=1 \
    --set 'mesh.refine=[{jump: pressure, above: 1 MPa, where: {half-space: {point: [0, 200 um], normal: [0, 1]}}}]'
silent base.yaml --set initial.1.material=water --set initial.1.density=998 --set materials.air=null \
    --set output.history.columns.V=null
changed 's/sphere: {center: .0, 100 um., radius: 20 um}/ellipsoid: {center: [0, 100 um], semi-axes: [50 um, 20 um]}/'
doubt 17:17 'a radius of 2e-05 m has 3.2 cells' base.yaml
changed 's/ellipsoid: {.*20 um.}/ring: {center: [0, 100 um], inner: 40 um, outer: 60 um}/'
doubt 17:12 'half of a shell of 1e-05 m has 1.6 cells' base.yaml
changed 's/ring: {.*60 um}/union: [{sphere: {center: [0, 100 um], radius: 50 um}}, {sphere: {center: [0, 180 um], radius: 10 um}}]/'
doubt 17:13 'a radius of 1e-05 m has 1.6 cells' base.yaml

# States far from all that the law is stated for.
cp right.yaml base.yaml
changed 's/density: 998.2/density: 998.2 g\/cm3/; s/20 MHz/100 kHz/'
doubt 16:50 "'water' at 998200 kg/m3 and 101325 Pa has a speed of sound of 51.4 m/s and a temperature of 0.3" base.yaml
grep -q "'stiffened-gas' is stated for 0 to 3000 kg/m3" said
cp right.yaml base.yaml
changed 's/density: 1.225/density: 1.225 g\/cm3/'
doubt 17:76 "'air' at 1225 kg/m3 and 101325 Pa has a speed of sound of 10.8 m/s and a temperature of 0.28" base.yaml
silent base.yaml --set 'initial.1.pressure=1 GPa' # as dense, but hot: an explosive
cp right.yaml base.yaml
changed 's/density: 1.225/temperature: 20/'
doubt 17:80 'a temperature of 20 K' base.yaml
silent base.yaml --set 'initial.1.temperature=20 degC'
doubt - 'a temperature of 2.03e+04 K' base.yaml --set initial.1.temperature=20300
silent right.yaml --set 'initial.0.density=11.3 g/cm3' --set "$wave.frequency=1 MHz" # lead by the law of a liquid

# Materials that are nowhere; a Lua layer may leave one out, a variant may have it.
cp right.yaml base.yaml
changed 's/^  air:/  oil: {eos: {type: stiffened-gas, preset: sg4}}\n&/'
doubt 14:3 "material 'oil' is nowhere: no layer, boundary or source has it" base.yaml
grep -q 'it costs two fields in every cell' said
silent base.yaml --set 'sources.mass.oil=0'
doubt 14:3 "material 'oil' is nowhere" base.yaml --set 'sources.heating.oil=0'
silent base.yaml --set 'initial.0.fractions={water: 1, oil: 0}' --set 'initial.0.density={water: 998.2}' \
    --set initial.0.material=null
silent base.yaml --set 'initial.1={lua: "return function() return {pressure = 1e5} end"}' --set 'initial.0.density=998' \
    --set materials.air=null --set output.history.columns.V=null
cat >>base.yaml <<'END'
variants: {oily: {initial: [{everywhere: true, material: oil, density: 900, pressure: 1 atm}]}}
END
silent base.yaml

# Outputs after the end, regions outside; a run that the command line cuts short is meant so.
cp right.yaml base.yaml
changed 's/every: 20 ns/every: 20 us/'
doubt 20:22 'output.snapshots.every: the run ends before that, at 1e-07 s: only its start and its end are written' base.yaml
silent base.yaml --set 'output.snapshots.every=100 ns'
silent right.yaml --until '5 ns'
doubt - 'output.checkpoints.every: the run ends before that' right.yaml --set 'output.checkpoints.every=1 ms'
doubt - 'output.maps.every: the run ends before that' right.yaml \
    --set 'output.maps={every: 1 us, wall: {boundary: y-, fields: [pressure]}}'
changed 's/every: 20 us/every: 20 steps/; s/run: {/&max-steps: 10, /'
doubt 20:22 'the run ends before that, after 10 steps' base.yaml
cp right.yaml base.yaml
changed 's/upper: .10 um, 10 um./upper: [10, 10]/; s/lower: .0, 0., upper: .10, /lower: [1, 0], upper: [10, /'
doubt 21:67 'output.history.columns.p.where: this region lies outside of the domain' base.yaml
grep -q 'the domain is 0 to 0.00025 m along the first axis: are the units right?' said
doubt - 'mesh.refine[0].where: this region lies outside' right.yaml --set mesh.levels=1 \
    --set 'mesh.refine=[{interface: air, where: {sphere: {center: [1 m, 0], radius: 0.5 m}}}]'
doubt - 'mesh.refine[0].region: this region lies outside' right.yaml --set mesh.levels=1 \
    --set 'mesh.refine=[{region: {half-space: {point: [0, 2 mm], normal: [0, 1]}}}]'
doubt - 'output.maps.skin.where: this region lies outside' right.yaml \
    --set 'output.maps={every: 10 ns, skin: {isosurface: air, fields: [pressure], where: {polygon: {vertices: [[1,1],[2,1],[2,2]]}}}}'
silent right.yaml --set mesh.levels=1 \
    --set 'mesh.refine=[{interface: air, where: {complement: {sphere: {center: [0, 0], radius: 1 nm}}}}]'

# A speck in a large domain is inside of it, however small its share.
cat >speck.yaml <<'END'
bulla: 1
domain:
  lower: [0, 0, 0]
  upper: [10 mm, 10 mm, 10 mm]
  cells: [64, 64, 64]
  boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow, z-: outflow, z+: outflow}
materials: {water: {eos: {type: stiffened-gas, preset: sg44}}, air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: water, density: 998.2, pressure: 1 atm}
  - {sphere: {center: [5 mm, 5 mm, 5 mm], radius: 1 um}, material: air, density: 1.225, pressure: 1 atm}
run: {until: 1 us}
mesh: {levels: 10, refine: [{interface: air}]}
END
silent speck.yaml

# The same words for programs, and no other exit code.
cp right.yaml base.yaml
changed 's/radius: 50 um/radius: 20 um/'
"$BULLA" check --json base.yaml >said
grep -q '^{"severity":"warning","file":"base.yaml","line":17,"column":14,"message":"initial\[1\].sphere: a radius of 2e-05 m has' said
"$BULLA" run base.yaml -o out --max-steps 1 --quiet 2>said
grep -q '^base.yaml:17:14: warning: ' said

# What the coarse copy cannot do is said, and refuses no case: how far it comes is the machine's. Where it is the case's own mesh
# the run would end there.
cat >long.yaml <<'END'
bulla: 1
title: Steps that are too long
domain: {lower: [0], upper: [1], cells: [320], boundaries: {x-: outflow, x+: outflow}}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: 1 bar}
  - {half-space: {point: [0.5], normal: [1]}, material: air, density: 0.125, pressure: 0.1 bar}
scheme: {dt: 15 us, guard: strict}
run: {until: 0.1}
END
"$BULLA" check long.yaml >told 2>said || fail "a copy is not the case" said
grep -q '^warning: on a coarse copy of the mesh, step [2-9] at t' said || fail "not said" said
grep -q '(from [1-8] steps on a coarse copy' told || fail "no time" told
code=0
"$BULLA" check long.yaml --set 'domain.cells=[32]' --set 'scheme.dt=150 us' >told 2>said || code=$?
[ $code = 2 ] && grep -q '^error: step 2 at t' said || fail "exit code $code" said
