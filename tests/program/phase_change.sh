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
# Past the end of the saturation curve (45.56 MPa): cells are counted, on any ranks, and on after a restart.
sed -e 's/ 2 bar/ 600 bar/' -e '/last(v)\/first/d' bubble.yaml >past.yaml
ranked past 1 3
resumed past 12 past-1
for folder in past-3 past-resumed bubble-1; do told $folder past_curve >$folder/past; done
told past-1 past_curve | cmp - past-3/past
told past-1 past_curve | cmp - past-resumed/past
grep -q '"cell_steps": *[1-9]' past-3/past || fail "no cell is past the end" past-3/past
grep -q '"cell_steps": *0' bubble-1/past || fail "cells are past the end below it" bubble-1/past
"$BULLA" run past.yaml -o loud >said 2>&1
grep -q 'water and steam: pressure was past the end of their saturation curve (45.56 MPa) in [1-9]' said || fail "no word" said
sed 's/^run:/scheme: {integrator: ssprk3}\nrun:/' bubble.yaml >three.yaml
"$BULLA" run three.yaml -o three --quiet # stages that build on each other count in part
"$BULLA" plan bubble.yaml >plan 2>said
grep -q '^  phase .*water to steam, equilibrium, at interfaces.*core/scheme/phase_change.c' plan || fail "no operator" plan
grep -q "rate: equilibrium' without conduction" said || fail "no warning" said
sed -e 's/water-2016}}/water-2016}, conductivity: 0.6 W\/m\/K}/' bubble.yaml >warm.yaml # what a pair has by itself
"$BULLA" plan warm.yaml >plan 2>said
grep -q '^  phase .*equilibrium, at interfaces, condensing from 0.9 of liquid on  \[' plan || fail "gases, and not told" plan
"$BULLA" plan warm.yaml --set 'phase-change=[{liquid: water, vapour: steam}]' >plan 2>said
grep -q '^  phase .*equilibrium, at interfaces from 0.99 of vapour on  \[' plan || fail "no gases, and not told" plan

# Heat flows, and superheated liquid evaporates at the vapour's end of its surface; faces of expanding mixtures have Wood's speed.
sed -e 's/water-2016}}/water-2016}, conductivity: 0.6 W\/m\/K}/' -e 's/gases: \[air\]/&, onset: 0.5/' \
    -e 's/^run:/scheme: {mixture-speed: wood, low-mach: 0.05}\nrun:/' bubble.yaml >heat.yaml
sed -e 's/onset: 0.5/onset: 0.9/' -e 's/2 bar/0.5 bar/' heat.yaml >hot.yaml
ranked hot 1 3
resumed hot 12 hot-1
"$BULLA" plan heat.yaml 2>&1 | grep "without conduction" && fail "warned of what is there"

# A step that fails: its replay knows which cells evaporate, to the bit.
sed 's/scheme: {.*/scheme: {guard: strict, dt: 30 ns}/' hot.yaml >fails.yaml # too long
"$BULLA" run fails.yaml -o fails --quiet >said 2>&1 && fail "the step did not fail" said
"$BULLA" info --replay fails/dump_*.h5 >said 2>&1 || fail "the replay gives something else" said
grep -q ' 0 of [0-9]* cells of the tile$' said || fail "the replay differs" said

# Liquid alone that a wave stretches beyond what it bears.
sed -e 's/gases: \[air\]}/gases: [air], where: everywhere, nucleation: {tension: 1 MPa}}/' -e '/sphere:/d' \
    -e 's/pressure: 40 bar/pressure: 2 bar, velocity: [0, -20]/' -e '/last(v)\/first/d' -e '/last(M)\/first/d' -e '/last(w) + last/d' bubble.yaml >tension.yaml
sed -i 's/^expect:/expect:\n  - {value: "last(v)", at-least: 1e-12}/' tension.yaml
ranked tension 1 3
resumed tension 12 tension-1

# Surface tension: liquid and vapour at pressures that differ by sigma kappa; what evaporates pays for its surface.
cat >round.yaml <<'END'
bulla: 1
title: A bubble of vapour with surface tension in a closed ball
domain: {geometry: spherical, lower: [0], upper: [13.1 um], cells: [96], boundaries: {x-: symmetry, x+: reflecting}}
mesh: {tile: 8}
materials:
  water: {eos: {type: nasg, preset: water-2016}}
  steam: {eos: {type: ideal-gas, preset: water-2016}}
surface-tension: {water+steam: 56.9 mN/m}
phase-change:
  - {liquid: water, vapour: steam}
initial:
  - {everywhere: true, material: water, temperature: 383.15 K, pressure: 1 atm}
  - {sphere: {center: [0], radius: 2.4 um}, material: steam, temperature: 400 K, pressure: 2 bar}
run: {until: 1 ms, max-steps: 400}
output:
  directory: out
  checkpoints: {every: 200 steps}
  history:
    columns: {w: {mass: water}, v: {mass: steam}, E: {total: energy}, S: {integral: surface_energy}, A: {volume: steam}}
expect:
  - {value: "abs((last(w) + last(v))/(first(w) + first(v)) - 1)", at-most: 1e-13}
  - {value: "abs(last(v)/first(v) - 1)", at-least: 1e-3}
  - {value: "abs(last(E) + last(S) - first(E) - first(S))/first(E)", at-most: 2e-15}
  - {value: "abs(last(S) - first(S))/first(E)", at-least: 1e-9}
END
ranked round 1 3
resumed round 200 round-1

refused() { # WORDS SED-EXPRESSION: the case, changed so, is refused with these words
    sed -e "$2" bubble.yaml >wrong.yaml
    ! "$BULLA" check wrong.yaml >out.txt 2>err.txt || fail "not refused: $1" out.txt
    grep -q "error: .*$1" err.txt || fail "not told: $1" err.txt
}
refused "there is no material 'stem'" 's/vapour: steam/vapour: stem/'
refused "'air' is a gas" 's/liquid: water, vapour: steam, gases: \[air\]/liquid: air, vapour: steam/'
refused "'water' is a liquid" 's/liquid: water, vapour: steam, gases: \[air\]/liquid: water, vapour: steam, gases: [water]/'
refused "'steam' is in this pair already" 's/gases: \[air\]/gases: [steam]/'
refused "'air' is in another pair: add a material" 's/- {liquid: water, vapour: steam, gases: \[air\].*/&\n  - {liquid: water, vapour: steam, gases: [air]}/; s/phase-change:/&\n  - {liquid: oil, vapour: air}/; s/^materials:/&\n  oil: {eos: {type: nasg, preset: water-2016}}/'
refused "'water' is a solid: name a fluid" 's/\(water: {eos: {type: nasg, preset: water-2016}\)/\1, constitutive: {type: neo-hookean, shear-modulus: 1 MPa, reference-density: 1000}/'
refused "'steam' has no state at .* beyond its spinodal" 's/nasg, preset: water-2016/iapws95, preset: water/; s/ideal-gas, preset: water-2016/iapws95-vapour, preset: water-vapour/'
refused "'steam' has no state at .* where its 'nucleus'" 's/gases: \[air\]/nucleus: 1e-5/; s/nasg, preset: water-2016/iapws95, preset: water/; s/ideal-gas, preset: water-2016/iapws95-vapour, preset: water-vapour/'
refused "have no saturation curve" 's/ideal-gas, preset: water-2016/ideal-gas, preset: water-vapour/'
refused "needs the closure kapila" 's/^run:/scheme: {closure: allaire}\nrun:/'
refused "does not give its entropy and enthalpy" 's/nasg, preset: water-2016/tait/'
refused "only with 'where: everywhere'" 's/gases: \[air\]/nucleation: {tension: 1 MPa}/'
refused "'onset' is for surfaces" 's/gases: \[air\]/where: everywhere, onset: 0.5/'
refused "'wood' is for mixtures of fluids" 's/^run:/scheme: {mixture-speed: wood}\nrun:/; s/  air: .*/&\n  gel: {eos: {type: stiffened-gas, preset: begostone}, constitutive: {type: neo-hookean, shear-modulus: 1 MPa, reference-density: 1000}}/'
refused "'steam' is a solid" 's/ideal-gas, preset: water-2016}/ideal-gas, preset: water-2016}, constitutive: {type: neo-hookean, shear-modulus: 1 MPa, reference-density: 1}/'

refused "alone, without a third material" 's/^initial:/surface-tension: {water+steam: 0.05}\ninitial:/'

refused "vapour of no pair" 's/evaporated: steam/evaporated: air/'
refused "known of the whole domain" 's/evaporated: steam/evaporated: steam, in: air/'
refused "nothing condenses" 's/gases: \[air\]/direction: evaporation, condense-from: 0.9/'
refused "nothing condenses" 's/gases: \[air\]/direction: evaporation, nucleus: 1e-5/'
refused "nothing condenses" 's/gases: \[air\]/direction: evaporation, condense-over: 8/'
refused "condensation has a rate already" 's/gases: \[air\]/condense-over: 8, rate: {type: relaxation, time: 1 us}/'
refused "the pair has no gases" 's/gases: \[air\]/gas-temperature: own/'
refused "'rate: lua' needs 'shared'" 's/gases: \[air\]/&, gas-temperature: own, rate: {type: lua, lua: "function() return 0 end"}/'

# Doubts: cells that do not see the heat, superheated liquid without onset, states beyond the end of the curve.
doubt() { # WORDS SED-EXPRESSION: the warmed case, changed so, is warned of with these words
    sed -e "$2" heat.yaml >doubt.yaml
    "$BULLA" check doubt.yaml >out.txt 2>err.txt || fail "refused: $1" err.txt
    grep -q "warning: .*$1" err.txt || fail "no doubt: $1" err.txt
}
doubt "0.76 of the finest cells of 1.56e-05 m" ''
"$BULLA" check heat.yaml --set run.until=1 2>&1 | grep "of the finest cells of 1.56" && fail "a layer that is wide enough"
doubt "superheated by .* and boils wherever" 's/, onset: 0.5//; s/everywhere: true, material: water, temperature: 360/everywhere: true, material: water, temperature: 420/'
doubt "'water' and 'steam' of initial\[2\] are mixed, and condense only at surfaces, where liquid fills 0.9" \
    's/, onset: 0.5//; s/fractions: {steam/fractions: {water: 0.1, steam/; s/air: 0.6/air: 0.5/'
doubt "'water' and 'steam' of initial\[2\] are mixed, and evaporate only at surfaces, where vapour fills 0.99" \
    's/, onset: 0.5//; s/, gases: \[air\]//; s/fractions: {steam/fractions: {water: 0.1, steam/; s/air: 0.6/air: 0.5/'
"$BULLA" check heat.yaml 2>&1 | grep "are mixed" && fail "a mixture where there is none"
doubt "beyond the end of the curve at 1116 K" 's/temperature: 360/temperature: 1200/'
doubt "beyond the beginning of the curve at 200 K" 's/temperature: 360/temperature: 190/'
doubt "beyond the end of the curve" 's/pressure: 40 bar/pressure: 1 GPa/'
doubt "'steam' of initial\[2\], 8e+04 Pa at 360 K, condenses at once where it meets 'water': saturation is 6.361e+04 Pa" ''
sed 's/{steam: 0.4, air: 0.6}/{steam: 0.31, air: 0.69}/' heat.yaml >wet.yaml
"$BULLA" check wet.yaml 2>&1 | grep "at once" && fail "warned of what is in equilibrium"
doubt "'water' of initial\[0\], 5e+04 Pa at 360 K, boils at once: saturation is 6.361e+04 Pa" 's/, onset: 0.5/, where: everywhere/; s/360, pressure: 2 bar}/360, pressure: 0.5 bar}/'
doubt "'water' of initial\[0\], its vapour at 5e+04 Pa at 360 K, boils at once" 's/, onset: 0.5//; s/true, material: water, temperature: 360, pressure: 2 bar}/true, fractions: {water: 0.9, steam: 0.1}, temperature: 360, pressure: 0.5 bar}/'
doubt "1e-07 of 'steam' in 'water' of initial\[0\] is a trace" 's/true, material: water,/true, fractions: {water: 0.9999999, steam: 0.0000001},/'
doubt "at 550 K (initial\[0\]) the saturation pressure of 'water' is 4.*e+06 Pa, -2. % off that of water" 's/true, material: water, temperature: 360, pressure: 2 bar/true, material: water, temperature: 550, pressure: 100 bar/'
doubt "at 550 K (initial\[0\]) the saturation pressure of 'wasser' is 4.*e+06 Pa, -2. % off that of water" \
    's/water\([^-]\)/wasser\1/g; s/true, material: wasser, temperature: 360, pressure: 2 bar/true, material: wasser, temperature: 550, pressure: 100 bar/'
sed 's/nasg, preset: water-2016/iapws95/; s/ideal-gas, preset: water-2016/iapws95-vapour/; s/, gases: \[air\]//' bubble.yaml >real.yaml
"$BULLA" check real.yaml >real.txt 2>/dev/null
grep -q "curve from 28" real.txt || fail "no curve of IAPWS-95" real.txt
grep "would evaporate again" real.txt && fail "a second root of IAPWS-95"
"$BULLA" check heat.yaml 2>/dev/null | grep -q "would evaporate again from 1.9.* GPa" || fail "no second root"

# Superheated water and its vapour of one temperature at rest: where the surface lies on faces of cells, and of tiles, it
# evaporates as within a cell, the same on any ranks, from its first steps. It is not told of then.
cat >touch.yaml <<'END'
bulla: 1
title: A surface on a face
domain: {lower: [0], upper: [8 um], cells: [32], boundaries: {x-: reflecting, x+: {type: non-reflecting, pressure: 1 atm}}}
mesh: {tile: 8}
materials:
  water: {eos: {type: nasg, preset: water-2016}, conductivity: 0.68 W/m/K}
  steam: {eos: {type: ideal-gas, preset: water-2016}, conductivity: 0.025 W/m/K}
phase-change:
  - {liquid: water, vapour: steam}
initial:
  - {everywhere: true, material: water, temperature: 373.7, pressure: 1 atm}
  - {half-space: {normal: [-1], point: [2 um]}, material: steam, temperature: 373.7, pressure: 1 atm}
run: {until: 0.02 us}
output:
  directory: out
  checkpoints: {every: 12 steps}
  history: {columns: {v: {mass: steam}, e: {evaporated: steam}}}
expect:
  - {value: "abs(last(v) - first(v) - last(e))/last(v)", at-most: 1e-13}
END
for onset in "" ", onset: 0.99"; do
    sed "s/vapour: steam/&$onset/" touch.yaml >face.yaml
    ranked face 1 2 3
    resumed face 12 face-1
    sed 's/2 um\]/2.005 um]/' face.yaml >within.yaml
    rm -rf within
    ran within within
    tail -qn 1 face-1/out/history.csv within/out/history.csv | awk -F, '{e[NR] = $5} END {exit !(e[1] > 0.95*e[2] && e[1] < 1.05*e[2])}' ||
        fail "what evaporates depends on where the surface begins" face-1/out/history.csv
    "$BULLA" run face.yaml --dry-run 2>&1 | grep "no cell holds" && fail "told of a surface that evaporates"
done

# A surface on faces of cells to which nothing carries heat, where nothing would evaporate, is told of before the first
# step; one in cells is not, nor is liquid that boils by itself, or a pair that exchanges no mass.
sed -e '/half-space/d; s/sphere: .*radius: 0.3 mm}/half-space: {normal: [0, 1], point: [0, 0.5 mm]}/' -e '/levels/s/levels: 1.*}]/levels: 0/' \
    bubble.yaml >face.yaml
for ranks in 1 2; do
    "$BULLA" run face.yaml --dry-run -n "$ranks" >out.txt 2>err.txt || fail "a surface on faces" err.txt
    [ "$(grep -c "phase-change\[0\]: no cell holds both 'water'" err.txt)" = 1 ] || fail "no word of a surface on faces" err.txt
done
sed 's/point: \[0, 0.5 mm\]/point: [0, 0.51 mm]/' face.yaml >inside.yaml
sed 's/gases: \[air\]/&, where: everywhere/' face.yaml >boils.yaml
sed 's/gases: \[air\]/&, rate: none/' face.yaml >none.yaml
for case in inside boils bubble none; do
    "$BULLA" run $case.yaml --dry-run 2>&1 | grep "no cell holds" && fail "warned of $case"
done

# Water by IAPWS-95 boils into an ideal steam.
sed -e 's/nasg, preset: water-2016/iapws95, preset: water/; s/ideal-gas, preset: water-2016/ideal-gas, gamma: 1.33, cv: 1398.5/' \
    -e 's/gases: \[air\]/&, calibrate: {temperature: 373.124 K, pressure: 1 atm, latent-heat: 2.2565 MJ\/kg}/' bubble.yaml >iapws.yaml
ranked iapws 1 3
resumed iapws 12 iapws-1

# Air by a cubic law.
sed 's/ideal-gas, preset: air/rkpr, preset: air/' bubble.yaml >cubic.yaml
ranked cubic 1 3

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

# A rate in Lua: that of Hertz and Knudsen again, to round-off; never past equilibrium; on any ranks; what it does wrong is said.
cat >lua.yaml <<'CASE'
bulla: 1
title: A rate of one's own
parameters: {A: 1000, s: 0.4}
domain: {lower: [0], upper: [1 mm], cells: [16], boundaries: {x-: reflecting, x+: reflecting}}
mesh: {tile: 4}
materials: {water: {eos: {type: nasg, preset: water-2016}}, steam: {eos: {type: ideal-gas, preset: water-2016}}, air: {eos: {type: ideal-gas, preset: air}}}
phase-change:
  - liquid: water
    vapour: steam
    gases: [air]
    rate:
      type: lua
      lua: |
        return function(p, T, p_eq, share, alpha)
          local R = 955 * 0.467015707
          return A * 2 * s / (2 - s) / sqrt(2 * pi * R * T) * (p_eq - share * p)
        end
initial:
  - {everywhere: true, fractions: {water: 0.5, steam: 0.2, air: 0.3}, temperature: 370, pressure: 1 bar}
run: {until: 1 us, max-steps: 10}
output: {directory: out, checkpoints: {every: 5 steps}, history: {columns: {e: {evaporated: steam}, m: {mass: steam}}}}
CASE
ranked lua 1 2
resumed lua 5 lua-1
mass() { awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "e") c = i } END { printf "%.9e\n", $c }' "$1/out/history.csv"; }
awk '/rate:/ { print "    rate: {type: hertz-knudsen, accommodation: 0.4, area: 1000}"; skip = 1; next } /^initial:/ { skip = 0 } !skip' lua.yaml | grep -v '^parameters' >hertz.yaml
ran hertz hertz
[ "$(mass hertz)" = "$(mass lua-1)" ] || fail "not the rate of Hertz and Knudsen: $(mass hertz) $(mass lua-1)"
sed 's/return A/return 1e9 * A/' lua.yaml >fast.yaml
awk '/rate:/ { skip = 1; next } /^initial:/ { skip = 0 } !skip' lua.yaml | grep -v '^parameters' >instant.yaml
ran fast fast
ran instant instant 2>/dev/null
[ "$(mass fast)" = "$(mass instant)" ] || fail "past equilibrium, or short of it: $(mass fast) $(mass instant)"
sed 's/return A/return -A/' lua.yaml >back.yaml
ran back back
[ "$(mass back)" = 0.000000000e+00 ] || fail "vapour that wants to come to be condenses"
wrong() { # WORDS SED-EXPRESSION: the run, changed so, ends with these words and code 2 or 3
    sed -e "$2" lua.yaml >wrong.yaml
    ! "$BULLA" run wrong.yaml --quiet --overwrite 2>said || fail "not seen: $1" said
    grep -q "error: .*$1" said || fail "not told: $1" said
}
wrong "wrong.yaml:16: attempt to perform arithmetic on a nil value (called with 100000, 370, .*); step 1 at t = 0 s" 's/return A/return nil + A/'
wrong "wrong.yaml:14: the script gives inf" 's/return A/return 1 \/ 0 * A/'
wrong "key 'lua' is missing" '/^      lua: /,/^        end/d'
