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
for geometry in cartesian axisymmetric; do
    for how in rkl2 explicit; do
        "$BULLA" run spot.yaml -o "spot-$how-$geometry" --set run.until='0.3 ns' --set scheme.diffusion=$how \
            --set domain.geometry=$geometry --quiet
    done
    [ "$(($(steps spot-rkl2-$geometry) * 20))" -lt "$(steps spot-explicit-$geometry)" ] || fail "no steps are saved with levels"
    near spot-rkl2-$geometry spot-explicit-$geometry T 0.0005
    near spot-rkl2-$geometry spot-explicit-$geometry v 0.02
done

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
said "goes with one material" --set 'materials.air={eos: {type: ideal-gas, gamma: 1.4}}'
said "goes with the midpoint rule" --set scheme.integrator=ssprk3
said "no material is viscous or conducts" --set materials.gel.viscosity=null --set materials.gel.conductivity=null \
    --set domain.boundaries.y+=no-slip
