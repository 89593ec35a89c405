# Sources: closed forms of what gravity, heat and mass do; the same bits whatever the ranks, the tiles and a restart; a
# script that fails is named with its place.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
fail() {
    echo "$*" >&2
    exit 1
}

# A force that grows with time, heat and gas at rest: uniform fields, which a midpoint rule follows exactly or nearly so.
cat >box.yaml <<'END'
bulla: 1
domain: {lower: [0, 0], upper: [1, 1], cells: [16, 16], boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic}}
mesh: {tile: 8}
materials: {gas: {eos: {type: ideal-gas, gamma: 1.4}}}
initial: [{everywhere: true, material: gas, density: 1.2, pressure: 1 bar}]
run: {until: 0.01}
output:
  history:
    every: 1 step
    columns: {u: {max: velocity_x}, v: {min: velocity_y}, p: {min: pressure}, rho: {max: density}, E: {total: energy}, m: {total: mass}}
END
cat >falls.yaml <<'END'
extends: box.yaml
sources: {acceleration: ["= 2e3 * t", -9.81], force: [3, 0]}
scheme: {cfl: 0.4}
expect:
  - {value: last(u), equals: 0.125, relative: 1e-12} # 1e3 t2 + 3 t/rho
  - {value: last(v), equals: -0.0981, relative: 1e-12}
  - {value: last(p), equals: 1e5, relative: 1e-12}
  - {value: "last(E) - first(E)", equals: 0.015149166, relative: 1e-5}
END
cat >warms.yaml <<'END'
extends: box.yaml
sources: {heating: 1e5}
expect:
  - {value: last(p), equals: 100400, relative: 1e-12} # (gamma - 1) q t
  - {value: max(u), equals: 0, tolerance: 1e-9}
END
cat >fills.yaml <<'END'
extends: box.yaml
sources: {mass: {gas: 0.3}}
initial: [{everywhere: true, material: gas, density: 1.2, pressure: 1 bar, velocity: [7, 0]}]
expect: # along the isentrope, at the velocity that is there
  - {value: last(rho), equals: 1.203, relative: 1e-12}
  - {value: last(p), equals: 100350.175, relative: 1e-8}
  - {value: last(u), equals: 7, relative: 1e-12}
END
# Heat for the gas of a mixture alone: the liquid stays on its isentrope, as the gas makes room for itself.
cat >mixture.yaml <<'END'
extends: box.yaml
materials: {water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 6 bar}}, gas: {eos: {type: ideal-gas, gamma: 1.4}}}
initial: [{everywhere: true, fractions: {water: 0.6, gas: 0.4}, density: {water: 1000, gas: 1.2}, pressure: 1 bar}]
sources: {heating: {gas: 2e6}}
output: {history: {columns: {a: {mean: alpha_gas}, w: {mean: density_water}, value: {value: "(p + 6e5)/w^4.4"}}}}
expect:
  - {value: last(value)/first(value), equals: 1, tolerance: 1e-7}
  - {value: last(p)/first(p), at-least: 1.05}
  - {value: last(a), at-least: 0.401}
END
for case in falls warms fills mixture; do
    "$BULLA" run $case.yaml -o $case >said 2>&1 || fail "$case: $(cat said)"
done
grep -q '"sources": "heating"' warms/provenance.json || fail "provenance does not say that sources act"
"$BULLA" plan falls.yaml | grep -q 'sources .*: acceleration, force' || fail "the plan says nothing of sources"
if "$BULLA" plan box.yaml | grep -q sources; then fail "the plan speaks of sources that are not there"; fi

# All of them in a moving picture with levels, a solid and two fluids.
cat >all.lua <<'END'
return function(x, y, z, t)
  local near = math.exp(-((x - 0.5) ^ 2 + (y - 0.4) ^ 2) / 0.02)
  return {
    acceleration = { 40 * math.sin(200 * t), -9.81 }, force_y = 1e4 * near, heating = { air = 1e7 * near, tissue = 1e8 },
    mass_water = 2e4 * near, stretch = { xy = 3 * near },
  }
end
END
cat >all.yaml <<'END'
bulla: 1
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: reflecting, x+: outflow, y-: reflecting, y+: non-reflecting}}
mesh: {levels: 1, tile: 8, refine: [{interface: air}, {jump: pressure, above: 0.05}]}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 6 bar}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  tissue: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 6 bar}, constitutive: {type: neo-hookean, shear-modulus: 20 kPa, reference-density: 1000}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1 bar}
  - {sphere: {center: [0.5, 0.6], radius: 0.2}, material: air, density: 1.2, pressure: 1 bar}
  - {box: {lower: [0, 0], upper: [1, 0.2]}, material: tissue, density: 1000, pressure: 1 bar}
sources: {lua: all.lua}
run: {until: 1.5 ms}
output:
  snapshots: {every: 1.5 ms, fields: [density, velocity, pressure, alpha_air, stretch_xx, stretch_xy], precision: double}
  history: {every: 1 step, columns: {E: {total: energy}, m: {total: mass}, a: {volume: air}, u: {max: velocity_x}, v: {min: velocity_y}, p: {max: pressure}, s: {max: stretch_xy}}}
  checkpoints: {every: 50 steps}
END
for ranks in 1 3; do
    mkdir $ranks
    (cd $ranks && "$BULLA" run ../all.yaml -o out -n $ranks) >said 2>&1 || fail "all on $ranks ranks: $(cat said)"
done
cmp 1/out/history.csv 3/out/history.csv || fail "results depend on ranks"
last=$(ls 1/out/fields/*.hdf | tail -1)
"$BULLA_BUILD/tests/test-unit-snapshot" "$last" "3${last#1}" || fail "fields depend on ranks"
"$BULLA" run all.yaml -o parts --max-steps 60 >said 2>&1 || fail "first half: $(cat said)"
"$BULLA" run all.yaml -o parts --restart >said 2>&1 || fail "second half: $(cat said)"
tail -1 1/out/history.csv >last.one
tail -1 parts/history.csv >last.parts
cmp last.one last.parts || fail "results depend on restarts: $(cat last.one last.parts)"

# No tile rests where a source acts, and a tile that leaves out what it does not hold gets the same bits: tiles of any size.
cat >plain.yaml <<'END'
extends: all.yaml
sources:
  lua: null
  acceleration: [= 40 * math.sin(200 * t), -9.81]
  force: [0, = 1e4 * math.exp(-(r - 0.6)^2 / 0.02)]
  heating: {air: = 1e7 * x, tissue: 1e8}
  mass: {water: = 2e4 * y}
  stretch: {xy: 3}
END
for case in all plain; do
    for tile in 8 16; do
        "$BULLA" run $case.yaml -o $case$tile --set mesh.levels=0 --set mesh.refine=null --set mesh.tile=$tile \
            --set output.checkpoints=null >said 2>&1 || fail "$case, tiles of $tile: $(cat said)"
        cut -d, -f1-3,7-10 $case$tile/history.csv >$case$tile.csv
    done
    cmp ${case}8.csv ${case}16.csv || fail "$case: results depend on tiles"
done

# A script that gives no number is stopped at once: with its line, its arguments, the step and the cell.
cat >nan.yaml <<'END'
extends: box.yaml
sources:
  heating: "= t > 0.004 and x > 0.9 and 0/0 or 1"
END
code=0
"$BULLA" run nan.yaml -o nan >said 2>&1 || code=$?
[ "$code" -eq 2 ] || [ "$code" -eq 3 ] || fail "a source of nan ended with $code: $(cat said)"
grep -q 'nan.yaml:3: the script gives nan, not a finite number (called with x,y,z,r,t = 0.90625' said ||
    fail "the script is not named: $(cat said)"
grep -q 'level 0, tile (1, 0, 0), sources at (0.90625, 0.03125, 0) m, in cell (6, 0, 0)' said ||
    fail "the place is not named: $(cat said)"
