# Viscosity in a mixture with levels and a wall that moves: the same bits on 1, 2, 3 ranks and after a restart; masses,
# momentum and energy stay to round-off; the plan shows the term; a failed step replays to the bit.
. "$BULLA_SOURCE/tests/lib.sh"
set -eu

cat >drop.yaml <<'END'
bulla: 1
title: A drop in a shear flow
domain: {lower: [-1 mm, 0], upper: [1 mm, 2 mm], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, y-: no-slip, y+: {type: no-slip, velocity: [2 m/s, 0]}}}
mesh: {tile: 8, levels: 1, refine: [{interface: oil}]}
materials:
  gas: {eos: {type: ideal-gas, gamma: 1.4}, viscosity: 1 mPa s}
  oil: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 1 MPa}, viscosity: {type: newtonian, mu: 50 mPa s, zeta: 20 mPa s}}
initial:
  - {everywhere: true, material: gas, density: 1.2, pressure: 1e5, velocity: ["= 1000*y", 0]}
  - {sphere: {center: [0.1 mm, 0.9 mm], radius: 0.5 mm}, material: oil, density: 100, pressure: 1e5, velocity: ["= 1000*y", 3]}
run: {until: 1, max-steps: 24}
output:
  directory: out
  checkpoints: {every: 8 steps}
  history: {columns: {m: {mass: oil}, M: {mass: gas}, E: {total: energy}, P: {total: momentum_x}, Q: {total: momentum_y}, u: {max: velocity_x}, p: {max: pressure}}}
END
ranked drop 1 2 3
resumed drop 8 drop-1
"$BULLA" plan drop.yaml >plan
grep -q '^  viscosity .*gas newtonian, oil newtonian .*core/scheme/viscous.c' plan || fail "not in the plan" plan

"$BULLA" check drop.yaml >said 2>&1
grep -q 'viscosity 50 mPa s at 100 kg/m3' said && grep -q 'jumps between cells are damped by up to' said || fail "check" said
"$BULLA" check drop.yaml --set materials.gas.viscosity=null --set materials.oil.viscosity=null >said 2>&1 || true
grep -q 'the wall drags nothing along' said || fail "a wall that moves in vain" said
grep -q 'without any viscosity a no-slip wall stops only' said || fail "a wall at rest in vain" said
"$BULLA" check drop.yaml >said 2>&1
! grep -q 'without any viscosity' said || fail "a wall that is not in vain" said
grep -q 'its steps: .* on level 0 (sound allows .* on level 1 (sound allows' said || fail "limits by level" said
grep -q 'reynolds  *gas [0-9.]*, oil [0-9.]*: flow of ' said || fail "reynolds" said

# Stress and heat as fields: on ranks to the bit, and refused where nothing is viscous.
cp drop.yaml fields.yaml
sed -i 's/max: pressure}}/max: pressure}, s: {max: stress_viscous_xy}, q: {max: dissipation}, z: {max: stress_viscous_zz}}/' fields.yaml
ranked fields 1 2
"$BULLA" check fields.yaml --set materials.gas.viscosity=null --set materials.oil.viscosity=null >said 2>&1 && fail "fields of nothing" said
grep -q "'stress_viscous_xy' is a field of viscous materials" said || fail "fields of nothing, why" said

# It acts, and it conserves: masses with walls, all with periodic boundaries.
"$BULLA" run drop.yaml -o free --set materials.gas.viscosity=0 --set materials.oil.viscosity=0 --quiet
! cmp -s free/history.csv drop-1/out/history.csv || fail "viscosity does nothing"
sed 's/y-: no-slip, y+: {[^}]*}/y-: periodic, y+: periodic/; s/"= 1000\*y"/"= 3*math.sin(y*1000*math.pi)"/g' drop.yaml >box.yaml
cat >>box.yaml <<'END'
expect:
  - {value: "max(abs(m/first(m) - 1))", at-most: 1e-13}
  - {value: "max(abs(M/first(M) - 1))", at-most: 1e-13}
  - {value: "max(abs(E/first(E) - 1))", at-most: 1e-13}
  - {value: "max(abs(P - first(P)))", at-most: 1e-17}
  - {value: "max(abs(Q/first(Q) - 1))", at-most: 1e-12}
END
"$BULLA" run box.yaml -o box --quiet || fail "not conserved" box/history.csv

# A step that fails near an edge of a tile: its replay has the neighbours that the strain was made of, to the bit.
cat >parting.yaml <<'E'
bulla: 1
title: Viscous streams that part
domain: {lower: [-1, -1], upper: [1, 1], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, y-: reflecting, y+: {type: no-slip, velocity: [5, 0]}}}
mesh: {tile: 8}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, viscosity: 1e3}
  air: {eos: {type: ideal-gas, gamma: 1.4}, viscosity: 1}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1 bar, velocity: ['= x > 0 and 900 or -900', '= y > 0 and 900 or -900']}
  - {sphere: {center: [0.1, 0.1], radius: 0.3}, material: air, density: 1, pressure: 1 bar, velocity: [0, 0]}
scheme: {closure: allaire, cfl: 0.9, guard: strict}
run: {until: 1, max-steps: 12}
E
"$BULLA" run parting.yaml -o parting --quiet >said 2>&1 && fail "the step did not fail" said
"$BULLA" info --replay parting/dump_*.h5 >said 2>&1 || fail "the replay gives something else" said
grep -q 'the same, to the bit' said || fail "the replay says nothing" said

# A bubble in a viscous liquid: pressures of its cells differ by the pull, on ranks to the bit, and after a restart.
cat >ring.yaml <<'E2'
bulla: 1
title: A bubble rings in a viscous liquid
domain: {geometry: spherical, lower: [0], upper: [20 um], cells: [64], boundaries: {x-: axis, x+: reflecting}}
mesh: {tile: 8, levels: 1, refine: [{interface: air}]}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, viscosity: 0.1}
  air: {eos: {type: ideal-gas, gamma: 1.4}, viscosity: 18.5 uPa s}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1 bar}
  - {sphere: {center: [0], radius: 4 um}, material: air, density: 2, pressure: 3 bar}
run: {until: 1, max-steps: 40}
output:
  directory: out
  checkpoints: {every: 16 steps}
  history: {every: 1 step, columns: {R: {equivalent-radius: air}, p: {max: pressure}, E: {total: energy}}}
E2
ranked ring 1 2 4
resumed ring 16 ring-1
"$BULLA" plan ring.yaml >said 2>&1
grep -q 'core/scheme/viscous.c' said || fail "the plan does not say where viscosity is" said
