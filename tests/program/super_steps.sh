# Super steps (scheme: {diffusion: rkl2}): the same bits on 1, 2 and 3 ranks, on tiles of 8 and 16 and after a restart; mass and
# energy to round-off; steps and state against explicit ones, around an axis, too; second order; the plan and `check` show
# them; where nothing binds a scene keeps its bits; what they do not go with is said. The same with finer levels that move.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >gel.yaml <<'END'
bulla: 1
title: A whirl in a thick liquid
domain: {lower: [0, 0], upper: [6.4 um, 6.4 um], cells: [32, 32], boundaries: {x-: symmetry, x+: no-slip, y-: no-slip, y+: {type: no-slip, temperature: 310 K}}}
mesh: {tile: 8}
materials:
  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa, cv: 590}, conductivity: 0.607 W/m/K, viscosity: 30 Pa s}
initial:
  - {everywhere: true, material: gel, temperature: 300 K, pressure: 1 atm, velocity: ["= 30 * math.sin(math.pi * x/6.4e-6)^2 * math.sin(2 * math.pi * y/6.4e-6)", "= -30 * math.sin(math.pi * y/6.4e-6)^2 * math.sin(2 * math.pi * x/6.4e-6)"]}
scheme: {cfl: 0.1, diffusion: rkl2}
run: {until: 60 ps}
output:
  directory: out
  checkpoints: {every: 5 steps}
  history: {columns: {M: {mass: gel}, E: {total: energy}, u: {max: velocity_x}, v: {min: velocity_y}, p: {max: pressure}}}
expect:
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-13}
END
ranked gel 1 2 3
resumed gel 5 gel-1

steps() { awk -F, 'END { print $1 }' "$1/history.csv"; }
value() { # DIR COLUMN: at the end
    awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i } END { print $c }' "$1/history.csv"
}
near() { # DIR DIR COLUMN PART
    awk "BEGIN { d = ($(value "$1" "$3")) / ($(value "$2" "$3")) - 1; exit !(d * d < $4 * $4) }" ||
        fail "$3: $(value "$1" "$3") in $1, $(value "$2" "$3") in $2"
}
# Against explicit steps; closed and without heat from outside energy stays, too.
for geometry in cartesian axisymmetric; do
    for how in rkl2 explicit; do
        "$BULLA" run gel.yaml -o "$how-$geometry" --set scheme.diffusion=$how --set domain.geometry=$geometry \
            --set domain.boundaries.y+=no-slip --quiet
    done
    [ "$(($(steps rkl2-$geometry) * 5))" -lt "$(steps explicit-$geometry)" ] || fail "no steps are saved"
    near rkl2-$geometry explicit-$geometry u 0.015
    near rkl2-$geometry explicit-$geometry v 0.015
    awk -F, 'NR == 2 { e = $5 } END { d = $5 / e - 1; exit !(d * d < 1e-26) }' rkl2-$geometry/history.csv ||
        fail "energy is lost" rkl2-$geometry/history.csv
done

# Tiles do not matter: extremes of one level.
for tile in 8 16; do
    "$BULLA" run gel.yaml -o tile-$tile --set mesh.tile=$tile --set 'expect=[]' --quiet \
        --set 'output.history={columns: {p: {max: pressure}, q: {min: pressure}, T: {max: temperature}, u: {max: velocity_x}}}'
    cmp tile-8/history.csv tile-$tile/history.csv
done

# Second order in time, against explicit steps.
cat >wave.yaml <<'END'
bulla: 1
title: Sound and heat of thin gas
domain: {lower: [0], upper: [12.8 um], cells: [64], boundaries: {x-: reflecting, x+: reflecting}}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}, conductivity: 0.0262 W/m/K, viscosity: 18.5 uPa s}
initial: [{everywhere: true, material: air, temperature: "= 300 + 30 * math.cos(math.pi * x/12.8e-6)", pressure: "= 1000 + 20 * math.cos(math.pi * x/12.8e-6)"}]
scheme: {limiter: van-albada, diffusion: rkl2}
run: {until: 8 ns}
output: {directory: out, history: {every: 1 step, columns: {T: {mean: temperature, where: {box: {lower: [0], upper: [3 um]}}}}}}
END
"$BULLA" run wave.yaml -o fine --set scheme.diffusion=explicit --set scheme.dt=1e-12 --quiet
for dt in 2e-10 1e-10 5e-11; do "$BULLA" run wave.yaml -o "wave-$dt" --set scheme.dt=$dt --quiet; done
awk "BEGIN { t = $(value fine T); a = $(value wave-2e-10 T) - t; b = $(value wave-1e-10 T) - t; c = $(value wave-5e-11 T) - t
    print a, b, c; exit !(a / b > 3.5 && b / c > 3.4 && a * a < 1e-6) }" || fail "not of second order"

# Where explicit steps do, none are taken.
for how in rkl2 explicit; do
    "$BULLA" run wave.yaml -o "idle-$how" --set scheme.diffusion=$how --set 'initial.0.pressure=101325' \
        --set 'domain.upper=[128 um]' --set scheme.dt=1e-11 --max-steps 20 --quiet
done
cmp idle-rkl2/history.csv idle-explicit/history.csv

# Finer levels take part: the same order, and bits where explicit steps do.
fine='mesh={tile: 8, levels: 1, refine: [{region: {box: {lower: [2 um], upper: [6 um]}}}]}'
"$BULLA" run wave.yaml -o fine-2 --set "$fine" --set scheme.diffusion=explicit --set scheme.dt=1e-12 --quiet
for dt in 2e-10 1e-10 5e-11; do "$BULLA" run wave.yaml -o "wave-2-$dt" --set "$fine" --set scheme.dt=$dt --quiet; done
awk "BEGIN { t = $(value fine-2 T); a = $(value wave-2-2e-10 T) - t; b = $(value wave-2-1e-10 T) - t; c = $(value wave-2-5e-11 T) - t
    print a, b, c; exit !(a / b > 3.4 && b / c > 3 && a * a < 1e-6) }" || fail "not of second order with levels"
for how in rkl2 explicit; do
    "$BULLA" run wave.yaml -o "idle-2-$how" --set "$fine" --set scheme.diffusion=$how --set 'initial.0.pressure=101325' \
        --set 'domain.upper=[128 um]' --set scheme.dt=1e-11 --max-steps 20 --quiet
done
cmp idle-2-rkl2/history.csv idle-2-explicit/history.csv

# A warm spot in thin gas that its finer cells follow: D dt/h^2 is 11 on the coarser level, and corrections after its step made
# 496 K of 309.
cat >spot.yaml <<'END'
bulla: 1
title: A warm spot in thin gas
domain: {lower: [0, 0], upper: [6.4 um, 6.4 um], cells: [32, 32], boundaries: {x-: symmetry, x+: no-slip, y-: no-slip, y+: no-slip}}
mesh: {tile: 8, levels: 1, regrid-every: 2, refine: [{jump: temperature, above: 0.005}, {region: {box: {lower: [0, 0], upper: [2 um, 1 um]}}}]}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}, conductivity: 0.0262 W/m/K, viscosity: 18.5 uPa s}
initial:
  - {everywhere: true, material: air, temperature: "= 300 + 300 * math.exp(-((x-2e-6)^2 + (y-3e-6)^2)/1e-12)", pressure: 1 kPa}
scheme: {cfl: 0.2, diffusion: rkl2}
run: {until: 1.6 ns}
output:
  directory: out
  checkpoints: {every: 3 steps}
  history: {every: 1 step, columns: {M: {mass: air}, E: {total: energy}, T: {max: temperature}, v: {max: velocity_y}, p: {mean: pressure}}}
expect:
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-13}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-13}
END
ranked spot 1 2 3
resumed spot 3 spot-1

# A bubble and a drop in thick liquid, a part of them in finer cells: curvatures there look at coarser ones as they are now.
cat >bubble.yaml <<'END'
bulla: 1
title: A bubble and a drop in thick liquid
domain: {lower: [0, 0], upper: [24 um, 24 um], cells: [24, 24], boundaries: {x-: symmetry, x+: reflecting, y-: periodic, y+: periodic}}
mesh: {tile: 4, levels: 1, refine: [{region: {box: {lower: [0, 0], upper: [10 um, 24 um]}}}]}
materials:
  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa, cv: 590}, viscosity: 1 Pa s}
  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}, viscosity: 18.5 uPa s}
  oil: {eos: {type: stiffened-gas, gamma: 3, p-inf: 500 MPa, cv: 800}}
surface-tension: {gel+air: 72 mN/m}
initial:
  - {everywhere: true, material: gel, density: 1000, pressure: 0.4 bar}
  - {box: {lower: [1 um, 12 um], upper: [22 um, 20 um]}, material: air, density: 5, pressure: 4 bar}
  - {sphere: {center: [8 um, 10 um], radius: 6 um}, material: oil, density: 900, pressure: 0.4 bar}
scheme: {diffusion: rkl2}
run: {until: 1, max-steps: 12}
output:
  directory: out
  checkpoints: {every: 5 steps}
  history: {every: 1 step, columns: {M: {mass: air}, p: {integral: pressure}, u: {max: velocity_x}}}
END
ranked bubble 1 2 3
resumed bubble 5 bubble-1
for geometry in cartesian axisymmetric; do
    for how in rkl2 explicit; do
        "$BULLA" run spot.yaml -o "spot-$how-$geometry" --set run.until='0.3 ns' --set scheme.diffusion=$how \
            --set domain.geometry=$geometry --quiet
    done
    [ "$(($(steps spot-rkl2-$geometry) * 20))" -lt "$(steps spot-explicit-$geometry)" ] || fail "no steps are saved with levels"
    near spot-rkl2-$geometry spot-explicit-$geometry T 0.0005
    near spot-rkl2-$geometry spot-explicit-$geometry v 0.02
done

# Two materials: hot thin gas in water. Masses and energy to round-off with finer levels that follow it, bits on ranks and after a
# restart; beside explicit steps; of second order. Rates of fractions made of a millionth of a volume a kPa here.
cat >hot.yaml <<'END'
bulla: 1
title: A hot bubble of thin gas in water
domain: {lower: [0, 0], upper: [6.4 um, 6.4 um], cells: [32, 32], boundaries: {x-: symmetry, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa, cv: 590}, conductivity: 0.377 W/m/K, viscosity: 0.89 mPa s}
  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}, conductivity: 0.0262 W/m/K, viscosity: 18.5 uPa s}
initial:
  - {everywhere: true, material: water, temperature: 300 K, pressure: 1 kPa}
  - {sphere: {center: [0, 3 um], radius: 2 um}, material: air, temperature: 600 K, pressure: 1 kPa}
scheme: {low-mach: 1, cfl: 0.4, diffusion: rkl2}
run: {until: 0.2 ns}
output:
  directory: out
  checkpoints: {every: 3 steps}
  history: {every: 1 step, columns: {m: {mass: air}, M: {mass: water}, E: {total: energy}, V: {volume: air}, T: {max: temperature_air}, p: {mean: pressure}}}
expect:
  - {value: "abs(last(m)/first(m) - 1)", at-most: 1e-13}
  - {value: "abs(last(M)/first(M) - 1)", at-most: 1e-13}
  - {value: "abs(last(E)/first(E) - 1)", at-most: 1e-13}
  - {value: max(guard_fallback + guard_relaxed + guard_retries), at-most: 0}
END
for how in rkl2 explicit; do "$BULLA" run hot.yaml -o "hot-$how" --set scheme.diffusion=$how --quiet; done
[ "$(($(steps hot-rkl2) * 15))" -lt "$(steps hot-explicit)" ] || fail "no steps are saved with two materials"
near hot-rkl2 hot-explicit T 0.0003
near hot-rkl2 hot-explicit p 0.0005
near hot-rkl2 hot-explicit V 1e-9
for dt in 2e-11 1e-11 5e-12; do "$BULLA" run hot.yaml -o "hot-$dt" --set scheme.dt=$dt --quiet; done
awk "BEGIN { t = $(value hot-explicit T); a = $(value hot-2e-11 T) - t; b = $(value hot-1e-11 T) - t; c = $(value hot-5e-12 T) - t
    print a, b, c; exit !(a / b > 2.3 && b / c > 3.2 && a < 0.06) }" || # the longest flows are taken in parts
    fail "not of second order with two materials"
for geometry in cartesian axisymmetric; do
    sed 's/mesh: {tile: 8}/mesh: {tile: 8, levels: 1, regrid-every: 2, refine: [{interface: air}]}/' hot.yaml >"rise-$geometry.yaml"
    sed -i "s/^domain: {/domain: {geometry: $geometry, /; s/^\(surface-tension\|scheme\)/&/" "rise-$geometry.yaml"
done
ranked rise-cartesian 1 2 3
resumed rise-cartesian 6 rise-cartesian-1
"$BULLA" run rise-axisymmetric.yaml -o rise-axis --quiet
# With surface tension what a surface stores is no more in the fluids: energy and surface together.
"$BULLA" run hot.yaml -o hot-tension --set 'surface-tension={water+air: 72.8 mN/m}' --set scheme.low-mach=0.05 --quiet \
    --set 'output.history.columns.S={integral: surface_energy}' \
    --set 'expect=[{value: "abs(last(E)/first(E) - 1)", at-most: 1e-7}, {value: "abs(last(m)/first(m) - 1)", at-most: 1e-13}]'

# Viscosity of mixed cells: a drop of water in a gel.
cat >drop.yaml <<'END'
bulla: 1
title: A drop of water in a thick gel
domain: {lower: [0, 0], upper: [6.4 um, 6.4 um], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, y-: no-slip, y+: {type: no-slip, velocity: [0.02 m/s, 0]}}}
mesh: {tile: 8}
materials:
  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa, cv: 590}, conductivity: 0.377 W/m/K, viscosity: 10 Pa s}
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa, cv: 700}, conductivity: 0.6 W/m/K, viscosity: 1 mPa s}
initial:
  - {everywhere: true, material: gel, temperature: 300 K, pressure: 1 atm, velocity: ["= 0.02*y/6.4e-6", 0]}
  - {sphere: {center: [3.1 um, 2.8 um], radius: 1.8 um}, material: water, temperature: 320 K, pressure: 1 atm, velocity: ["= 0.02*y/6.4e-6", 0]}
scheme: {low-mach: 1, cfl: 0.2, diffusion: rkl2}
run: {until: 0.2 ns}
output: {directory: out, history: {every: 1 step, columns: {E: {total: energy}, v: {max: velocity_y}, P: {total: momentum_x}, T: {max: temperature_water}}}}
END
for how in rkl2 explicit; do "$BULLA" run drop.yaml -o "drop-$how" --set scheme.diffusion=$how --quiet; done
[ "$(($(steps drop-rkl2) * 10))" -lt "$(steps drop-explicit)" ] || fail "no steps are saved in a gel with a drop"
near drop-rkl2 drop-explicit v 0.03
near drop-rkl2 drop-explicit P 0.001
near drop-rkl2 drop-explicit T 1e-6
near drop-rkl2 drop-explicit E 1e-9

# Few steps: two of the default Courant number spread this spot by more than its width. Flows that bend are taken in parts; in one
# they left it 5 K too warm.
"$BULLA" run spot.yaml -o spot-few --set run.until='0.3 ns' --set scheme.cfl=0.8 --quiet
[ "$(steps spot-few)" -le 3 ] || fail "these are not few steps"
awk "BEGIN { d = $(value spot-few T) - $(value spot-explicit-cartesian T); print d; exit !(d * d < 0.01) }" || fail "a spot is off with few steps"

"$BULLA" plan gel.yaml >plan
grep -q '3 to 63 stages of RKL2.*core/solve/rkl.c' plan || fail "not in the plan" plan
"$BULLA" check gel.yaml >out.txt 2>&1
grep -q 'rkl2 takes [0-9]* stages' out.txt || fail "check says no stages" out.txt
# Memory of the arrays, which `check` counts.
for how in rkl2 explicit; do
    "$BULLA" check gel.yaml --set scheme.diffusion=$how --set 'domain.cells=[1024, 1024]' 2>&1 | sed -n 's/^  memory  *about \([0-9.]*\) MiB.*/\1/p' >memory-$how
done
awk "BEGIN { r = $(cat memory-rkl2) / $(cat memory-explicit); exit !(r > 1.95 && r < 2.05) }" || fail "check does not count the arrays" memory-rkl2
"$BULLA" plan spot.yaml >plan-2
grep -q 'half of a step of level 0 before it.*on all levels' plan-2 || fail "not in the plan with levels" plan-2
"$BULLA" check spot.yaml --set scheme.diffusion=rkl2 >check-2
grep -q 'rkl2 takes [0-9]* stages of all levels before and after each step' check-2 || fail "check counts no flows" check-2
said() { # WORDS ARGS...
    words=$1
    shift
    "$BULLA" check gel.yaml "$@" >out.txt 2>&1 || true
    grep -q "$words" out.txt || fail "not said: $words" out.txt
}
said "does not go with 'gas-diffusion'" --set 'materials.air={eos: {type: ideal-gas, preset: air}}' --set 'materials.steam={eos: {type: ideal-gas, preset: steam}}' \
    --set 'gas-diffusion=[{gases: [air, steam], D: 2e-5}]'
"$BULLA" plan hot.yaml >plan-3
grep -q 'half of a step of level 0 before it.*core/solve/flow.c' plan-3 || grep -q 'core/solve/flow.c' plan-3 || fail "not in the plan with two materials" plan-3
"$BULLA" check hot.yaml 2>&1 | grep -q 'rkl2 takes [0-9]* stages of its own before and after each step' || fail "check counts no flows of two materials"
said "goes with the midpoint rule" --set scheme.integrator=ssprk3
said "no material is viscous or conducts" --set materials.gel.viscosity=null --set materials.gel.conductivity=null \
    --set domain.boundaries.y+=no-slip
