# Phase change, an operator after every stage: a bubble of steam and air in water that a wave crosses, in the plane, with levels. The same
# bits on 1, 2 and 3 ranks and after a restart; mass and energy to round-off; the plan shows it; what cannot be is refused.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >bubble.yaml <<'END'
bulla: 1
title: A bubble of steam and air
domain: {lower: [0, 0], upper: [1 mm, 1 mm], cells: [32, 32], boundaries: {x-: symmetry, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8, levels: 1, regrid-every: 4, refine: [{interface: water}]}
materials:
  water: {eos: {type: nasg, preset: water-2016}}
  steam: {eos: {type: ideal-gas, preset: water-2016}}
  air: {eos: {type: ideal-gas, preset: air}}
phase-change:
  - {liquid: water, vapour: steam, gases: [air]}
initial:
  - {everywhere: true, material: water, temperature: 360, pressure: 2 bar}
  - {half-space: {normal: [0, 1], point: [0, 0.2 mm]}, material: water, temperature: 360, pressure: 40 bar}
  - {sphere: {center: [0, 0.5 mm], radius: 0.3 mm}, fractions: {steam: 0.4, air: 0.6}, temperature: 360, pressure: 2 bar}
run: {until: 1 ms, max-steps: 24}
output:
  directory: out
  checkpoints: {every: 12 steps}
  history:
    columns: {w: {mass: water}, v: {mass: steam}, M: {mass: air}, E: {total: energy}, e: {evaporated: steam}}
expect:
  - {value: "abs((last(w) + last(v))/(first(w) + first(v)) - 1)", at-most: 1e-12}
  - {value: "abs(last(v)/first(v) - 1)", at-least: 1e-4}
  - {value: "abs(last(v) - first(v) - last(e))/last(v)", at-most: 1e-14}
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-12}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-12}
END
ranked bubble 1 2 3
resumed bubble 12 bubble-1
sed 's/^run:/scheme: {integrator: ssprk3}\nrun:/' bubble.yaml >three.yaml
"$BULLA" run three.yaml -o three --quiet # stages that build on each other count in part
"$BULLA" plan bubble.yaml >plan 2>said
grep -q '^  phase .*water to steam, equilibrium, at interfaces.*core/scheme/phase_change.c' plan || fail "no operator" plan
grep -q "rate: equilibrium' without conduction" said || fail "no warning" said

# Heat flows, and liquid evaporates where vapour fills half a cell; faces of expanding mixtures have Wood's speed.
sed -e 's/water-2016}}/water-2016}, conductivity: 0.6 W\/m\/K}/' -e 's/gases: \[air\]/&, onset: 0.5/' \
    -e 's/^run:/scheme: {mixture-speed: wood, low-mach: 0.05}\nrun:/' bubble.yaml >heat.yaml
ranked heat 1 3
resumed heat 12 heat-1
"$BULLA" plan heat.yaml 2>&1 | grep "without conduction" && fail "warned of what is there"

# Liquid alone that a wave stretches beyond what it bears.
sed -e 's/gases: \[air\]}/gases: [air], where: everywhere, nucleation: {tension: 1 MPa}}/' -e '/sphere:/d' \
    -e 's/pressure: 40 bar/pressure: 2 bar, velocity: [0, -20]/' -e '/last(v)\/first/d' -e '/last(M)\/first/d' -e '/last(w) + last/d' bubble.yaml >tension.yaml
sed -i 's/^expect:/expect:\n  - {value: "last(v)", at-least: 1e-12}/' tension.yaml
ranked tension 1 3
resumed tension 12 tension-1

refused() { # WORDS SED-EXPRESSION: the case, changed so, is refused with these words
    sed -e "$2" bubble.yaml >wrong.yaml
    ! "$BULLA" check wrong.yaml >out.txt 2>err.txt || fail "not refused: $1" out.txt
    grep -q "error: .*$1" err.txt || fail "not told: $1" err.txt
}
refused "there is no material 'stem'" 's/vapour: steam/vapour: stem/'
refused "'air' is a gas" 's/liquid: water, vapour: steam, gases: \[air\]/liquid: air, vapour: steam/'
refused "'water' is a liquid" 's/liquid: water, vapour: steam, gases: \[air\]/liquid: water, vapour: steam, gases: [water]/'
refused "'steam' is in this pair already" 's/gases: \[air\]/gases: [steam]/'
refused "have no saturation curve" 's/ideal-gas, preset: water-2016/ideal-gas, preset: water-vapour/'
refused "needs the closure kapila" 's/^run:/scheme: {closure: allaire}\nrun:/'
refused "does not give its entropy and enthalpy" 's/nasg, preset: water-2016/tait/'
refused "only with 'where: everywhere'" 's/gases: \[air\]/nucleation: {tension: 1 MPa}/'
refused "'onset' is for surfaces" 's/gases: \[air\]/where: everywhere, onset: 0.5/'
refused "'wood' is for mixtures of fluids" 's/^run:/scheme: {mixture-speed: wood}\nrun:/; s/  air: .*/&\n  gel: {eos: {type: stiffened-gas, preset: begostone}, constitutive: {type: neo-hookean, shear-modulus: 1 MPa, reference-density: 1000}}/'
refused "'steam' is a solid" 's/ideal-gas, preset: water-2016}/ideal-gas, preset: water-2016}, constitutive: {type: neo-hookean, shear-modulus: 1 MPa, reference-density: 1}/'

refused "vapour of no pair" 's/evaporated: steam/evaporated: air/'
refused "known of the whole domain" 's/evaporated: steam/evaporated: steam, in: air/'
refused "nothing condenses" 's/gases: \[air\]/direction: evaporation, condense-from: 0.9/'

# Doubts: cells that do not see the heat, superheated liquid without onset, states beyond the end of the curve.
doubt() { # WORDS SED-EXPRESSION: the warmed case, changed so, is warned of with these words
    sed -e "$2" heat.yaml >doubt.yaml
    "$BULLA" check doubt.yaml >out.txt 2>err.txt || fail "refused: $1" err.txt
    grep -q "warning: .*$1" err.txt || fail "no doubt: $1" err.txt
}
doubt "0.76 of the finest cells of 1.56e-05 m" ''
"$BULLA" check heat.yaml --set run.until=1 2>&1 | grep "of the finest cells of 1.56" && fail "a layer that is wide enough"
doubt "superheated by .* and boils wherever" 's/, onset: 0.5//; s/everywhere: true, material: water, temperature: 360/everywhere: true, material: water, temperature: 420/'
doubt "beyond the end of the curve" 's/pressure: 40 bar/pressure: 1 GPa/'
"$BULLA" check heat.yaml 2>/dev/null | grep -q "would evaporate again from 1.9.* GPa" || fail "no second root"

# Water by IAPWS-95 boils into an ideal steam.
sed -e 's/nasg, preset: water-2016/iapws95, preset: water/; s/ideal-gas, preset: water-2016/ideal-gas, gamma: 1.33, cv: 1398.5/' \
    -e 's/gases: \[air\]/&, calibrate: {temperature: 373.124 K, pressure: 1 atm, latent-heat: 2.2565 MJ\/kg}/' bubble.yaml >iapws.yaml
ranked iapws 1 3
resumed iapws 12 iapws-1

# Zeros of energy and entropy from where it boils.
sed -e 's/gases: \[air\]/gases: [air], calibrate: {temperature: 373.124 K, pressure: 1 atm, latent-heat: 2.2565 MJ\/kg}/' \
    -e 's/ideal-gas, preset: water-2016/ideal-gas, preset: water-vapour/' bubble.yaml >set.yaml
"$BULLA" check set.yaml >out.txt 2>err.txt || fail "calibrate" err.txt
grep -q "boils at 373.12 K at 1 atm" out.txt || fail "no boiling point" out.txt
grep -q "latent heat 2.2[56]" out.txt || fail "no latent heat" out.txt

# Fields of the pair: the curve of the references at 360 K, and at that pressure; a tenth of the mass is steam in every cell.
cat >fields.yaml <<'CASE'
bulla: 1
title: Liquid and vapour as fields
domain: {lower: [0], upper: [1 mm], cells: [8], boundaries: {x-: reflecting, x+: reflecting}}
materials: {water: {eos: {type: nasg, preset: water-2016}}, steam: {eos: {type: ideal-gas, preset: water-2016}}}
phase-change: [{liquid: water, vapour: steam, rate: {type: relaxation, time: 1 s}}]
initial:
  - {everywhere: true, fractions: {water: 0.5, steam: 0.5}, temperature: 370, pressure: 63611.973390880049}
  - {half-space: {point: [0.5 mm], normal: [1]}, fractions: {water: 0.5, steam: 0.5}, temperature: 360, pressure: 63611.973390880049}
run: {until: 1 ns, max-steps: 1}
output:
  directory: out
  history:
    columns: {p: {min: saturation_pressure_steam}, T: {min: saturation_temperature_steam}, s: {max: superheat_steam}, z: {min: superheat_steam}, m: {mass: steam}, w: {mass: water}, q: {max: quality_steam}}
expect:
  - {value: "first(p)", equals: 63611.973390880049, relative: 1e-9}
  - {value: "first(T)", equals: 360, relative: 1e-9}
  - {value: "first(s)", equals: 10, relative: 1e-6}
  - {value: "first(z)", equals: 0, tolerance: 1e-6}
  - {value: "first(q)", equals: 3.9879e-4, relative: 2e-2}
CASE
"$BULLA" run fields.yaml --quiet
code=0
"$BULLA" check fields.yaml --set 'output.history.columns={x: {max: quality_water}}' >said 2>&1 || code=$?
[ "$code" = 2 ] && grep -q "no field .quality_water" said || fail "quality of a liquid is no field" said
