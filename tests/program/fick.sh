# Gases that diffuse through each other: a bubble of steam and air beside a cloud of air, in water, in the plane, with levels, as a wave
# crosses it and it evaporates. The same bits on 1, 2 and 3 ranks and after a restart; masses, momentum and energy to round-off; the
# plan and `check` show it; what cannot be is refused.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >mingle.yaml <<'END'
bulla: 1
title: Gases that mingle
domain: {lower: [0, 0], upper: [1 mm, 1 mm], cells: [32, 32], boundaries: {x-: symmetry, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8, levels: 1, regrid-every: 4, refine: [{interface: steam}]}
materials:
  water: {eos: {type: nasg, preset: water-2016}}
  steam: {eos: {type: ideal-gas, preset: water-2016}}
  air: {eos: {type: ideal-gas, preset: air}}
gas-diffusion:
  - {gases: [steam, air], diffusivity: 2500 mm2/s}
initial:
  - {everywhere: true, material: water, temperature: 360, pressure: 2 bar}
  - {half-space: {normal: [0, 1], point: [0, 0.2 mm]}, material: water, temperature: 360, pressure: 10 bar}
  - {sphere: {center: [0, 0.5 mm], radius: 0.3 mm}, material: air, temperature: 360, pressure: 2 bar}
  - {sphere: {center: [0, 0.6 mm], radius: 0.15 mm}, fractions: {steam: 0.8, air: 0.2}, temperature: 500, pressure: 2 bar}
run: {until: 1 ms, max-steps: 24}
output:
  directory: out
  checkpoints: {every: 12 steps}
  history:
    columns: {w: {mass: water}, v: {mass: steam}, M: {mass: air}, E: {total: energy}, px: {total: momentum_x}, x: {mass: steam, where: {sphere: {center: [0, 0.6 mm], radius: 0.15 mm}}}}
expect:
  - {value: "abs(last(w)/first(w) - 1)", at-most: 1e-13}
  - {value: "abs(last(v)/first(v) - 1)", at-most: 1e-13}
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-13}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-13}
  - {value: "last(x)/first(x)", at-most: 0.95}
END
ranked mingle 1 2 3
resumed mingle 12 mingle-1
"$BULLA" plan mingle.yaml >plan
grep -q '^  fick .*steam, air.*core/scheme/fick.c' plan || fail "no term" plan
"$BULLA" check mingle.yaml >out.txt
grep -q 'gases  *steam, air diffuse: 0.0025 m2/s at 298.15 K' out.txt || fail "no word of its steps" out.txt

# Beside phase change and conduction.
sed -e 's/water-2016}}/water-2016}, conductivity: 0.6 W\/m\/K}/' -e '/last(w)/d' -e '/last(v)/d' \
    -e 's/^gas-diff/phase-change: [{liquid: water, vapour: steam, gases: [air], condense-from: 0.9}]\ngas-diff/' mingle.yaml >boil.yaml
ranked boil 1 3
resumed boil 12 boil-1

# Hot air alone in its tile asks for no steps, also while the tile may hold steam as far as it knows: at the start, and after a
# restart.
cat >alone.yaml <<'END_ALONE'
bulla: 1
title: Hot air, and steam far away
domain: {lower: [0], upper: [32 um], cells: [32], boundaries: {x-: reflecting, x+: reflecting}}
mesh: {tile: 8}
materials:
  steam: {eos: {type: ideal-gas, preset: water-2016}}
  air: {eos: {type: ideal-gas, preset: air}}
gas-diffusion: [{gases: [steam, air], diffusivity: 2500 mm2/s}]
initial:
  - {everywhere: true, material: air, temperature: 400, pressure: 1 bar}
  - {box: {lower: [0], upper: [8 um]}, material: air, temperature: 2000, pressure: 1 bar}
  - {box: {lower: [20 um], upper: [32 um]}, material: steam, temperature: 400, pressure: 1 bar}
run: {until: 1 s, max-steps: 6}
output: {checkpoints: {every: 3 steps}, history: {columns: {v: {mass: steam}, p: {max: pressure}}}}
END_ALONE
ranked alone 1 3
resumed alone 3 alone-1
awk -F, 'END { exit !($3 > 1e-11) }' alone-1/out/history.csv || fail "hot air sets the time step" alone-1/out/history.csv # 3.2 ps

# Without the key nothing is left of it.
sed '/gas-diffusion:/,+1d' mingle.yaml >plain.yaml
"$BULLA" plan plain.yaml >plan
grep fick plan && fail "a term that is not wanted"

refused_case() { # WORDS SED-EXPRESSION: the case, changed so, is refused with these words
    sed -e "$2" mingle.yaml >wrong.yaml
    ! "$BULLA" check wrong.yaml >out.txt 2>err.txt || fail "not refused: $1" out.txt
    grep -q "error: .*$1" err.txt || fail "not told: $1" err.txt
}
refused_case "there is no material 'stem'" 's/gases: \[steam, air\]/gases: [stem, air]/'
refused_case "one gas diffuses through another" 's/gases: \[steam, air\]/gases: [air]/'
refused_case "'air' is named already" 's/gases: \[steam, air\]/gases: [air, air]/'
refused_case "volume must move with mass" 's/^run:/scheme: {closure: allaire}\nrun:/'
refused_case "'water' is a liquid" 's/gases: \[steam, air\]/gases: [water, steam]/'
refused_case "'steam' is a solid" 's/ideal-gas, preset: water-2016}/ideal-gas, preset: water-2016}, constitutive: {type: neo-hookean, shear-modulus: 1 MPa, reference-density: 1}/'

# Little gas in a liquid, however fast it would mingle, asks for no steps either.
cat >little.yaml <<'END_LITTLE'
bulla: 1
title: Traces of two gases in thin water
domain: {lower: [0], upper: [32 um], cells: [32], boundaries: {x-: reflecting, x+: reflecting}}
materials:
  water: {eos: {type: nasg, preset: water-2016}}
  steam: {eos: {type: ideal-gas, preset: water-2016}}
  air: {eos: {type: ideal-gas, preset: air}}
gas-diffusion: [{gases: [steam, air], diffusivity: 2500 mm2/s}]
initial: [{everywhere: true, fractions: {water: 0.996, steam: 0.002, air: 0.002}, temperature: 300, pressure: 1 kPa}]
run: {until: 1 s, max-steps: 4}
output: {history: {columns: {v: {mass: steam}}}}
END_LITTLE
"$BULLA" run little.yaml --quiet -o little
awk -F, 'END { exit !($3 > 1e-10) }' little/history.csv || fail "little gas sets the time step" little/history.csv
