# Surface tension: the same bits on ranks, with levels and after a restart; what makes no sense is refused at its place.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >bubble.yaml <<'END'
bulla: 1
title: tension
domain: {geometry: spherical, lower: [0], upper: [64 um], cells: [64], boundaries: {x-: axis, x+: non-reflecting}}
mesh: {tile: 8, levels: 2, refine: [{interface: air}]}
materials: {water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}, air: {eos: {type: ideal-gas, gamma: 1.4}}}
surface-tension: {water+air: 72.8 mN/m}
initial:
  - {everywhere: true, material: water, density: 998.2, pressure: 1 atm}
  - {sphere: {center: [0], radius: 4 um}, material: air, density: 1.2, pressure: 2 atm}
run: {until: 150 ns}
output:
  snapshots: {every: 150 ns, fields: [density, velocity, pressure, alpha_air, surface_energy], precision: double}
  history: {every: 1 step, columns: {E: {total: energy}, V: {volume: air}, S: {integral: surface_energy}, u: {max: velocity_x}, p: {max: pressure}}}
  checkpoints: {every: 20 steps}
END
for ranks in 1 3; do
    mkdir $ranks
    (cd $ranks && "$BULLA" run ../bubble.yaml -o out -n $ranks) >said 2>&1 || fail "$ranks ranks" said
done
cmp 1/out/history.csv 3/out/history.csv || fail "results depend on ranks"
last=$(ls 1/out/fields/*.hdf | tail -1)
"$BULLA_BUILD/tests/test-unit-snapshot" "$last" "3${last#1}" || fail "fields depend on ranks"
"$BULLA" run bubble.yaml -o parts --max-steps 30 >said 2>&1 || fail "first half" said
"$BULLA" run bubble.yaml -o parts --restart >said 2>&1 || fail "second half" said
tail -1 1/out/history.csv >last.one
tail -1 parts/history.csv >last.parts
cmp last.one last.parts || fail "results depend on restarts" last.one last.parts
"$BULLA" plan bubble.yaml | grep -q 'tension .*: water+air 0.0728 N/m' || fail "the plan says nothing of it"
"$BULLA" check bubble.yaml >said 2>&1 || fail "check" said
grep -q 'asks for 36.4 kPa more in the sphere of initial\[1\], which begins with 101.3 kPa more' said || fail "the jump" said
"$BULLA" run bubble.yaml -o none --set surface-tension=null --max-steps 1 >said 2>&1 || fail "without" said
if "$BULLA" plan bubble.yaml --set surface-tension=null | grep -q tension; then fail "the plan speaks of what is not there"; fi

# A mist in a gas, with less than surface tension takes off the pressure of the gas in it.
code=0
"$BULLA" run bubble.yaml -o low --set 'initial=[{everywhere: true, material: air, density: 1.2, pressure: 1 bar}, {sphere: {center: [0], radius: 4 um}, fractions: {water: 0.9, air: 0.1}, density: {water: 998.2, air: 1.2}, pressure: 1 kPa}]' >said 2>&1 || code=$?
[ $code = 2 ] || fail "exit code $code" said
grep -q "initial state is not admissible: pressure = -.* 'air' .*, off which surface tension takes .* ('balance: tension' of a layer" said || fail "the mist" said

# In the plane the curvature is made before each stage, and travels with the layers of the frames: an oval on a finer
# level, between all kinds of boundaries.
cat >plane.yaml <<'END'
bulla: 1
title: tension in the plane
domain: {lower: [-8 um, -8 um], upper: [8 um, 8 um], cells: [32, 32], boundaries: {x-: reflecting, x+: outflow, y-: no-slip, y+: non-reflecting}}
mesh: {tile: 8, levels: 1, refine: [{interface: air}]}
materials: {water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}, air: {eos: {type: ideal-gas, gamma: 1.4}}}
surface-tension: {water+air: 72.8 mN/m}
initial:
  - {everywhere: true, material: water, density: 998.2, pressure: 1 atm}
  - {ellipsoid: {center: [0.6 um, 0], semi-axes: [3.3 um, 2.4 um]}, material: air, density: 1.2, pressure: 1.2 atm}
run: {until: 5 ns}
output:
  snapshots: {every: 5 ns, fields: [density, velocity, pressure, alpha_air, surface_energy], precision: double}
  history: {every: 1 step, columns: {E: {total: energy}, m: {mass: air}, S: {integral: surface_energy}, u: {max: velocity_x}, p: {max: pressure}}}
  checkpoints: {every: 20 steps}
expect: [{value: "max(abs(m/first(m) - 1))", at-most: 1e-13}, {value: max(u), at-least: 0.05}, {value: max(guard_fallback + guard_relaxed), at-most: 0}]
END
ranked plane 1 3
resumed plane 30 plane-1
"$BULLA" plan plane.yaml >said || fail "plan"
grep -q 'alpha: thinc across surfaces, mc along)' said || fail "the plan says nothing of how surfaces lie" said
"$BULLA" plan plane.yaml --set surface-tension=null >said || fail "plan"
grep -q 'alpha: superbee)' said || fail "without tension" said
"$BULLA" plan plane.yaml --set scheme.along-limiter=koren >said || fail "plan"
grep -q 'alpha: thinc across surfaces, koren along)' said || fail "a limiter of its own along surfaces" said
"$BULLA" check plane.yaml --set scheme.interface-along=axes --set scheme.along-limiter=koren >said 2>&1 || fail "check" said
grep -q "'along-limiter' is for surfaces that lie as they like, and has no effect" said || fail "no word about axes" said
"$BULLA" check bubble.yaml --set scheme.interface-along=normal >said 2>&1 || fail "check" said
grep -q "'interface-along: normal' is about surfaces .* has no effect here" said || fail "no word about a line" said

# How surfaces lie is looked at without tension, too, if a case says so.
sed -e 's/^surface-tension: .*/scheme: {interface-limiter: thinc, interface-along: normal}/' -e 's/pressure: 1.2 atm}/pressure: 1.2 atm, velocity: [40, 90]}/' \
    -e 's/ u: {max/ v: {max: alpha_air}, u: {max/' plane.yaml >slid.yaml
ranked slid 1 3
resumed slid 30 slid-1
sed 's/^run:/scheme: {interface-along: normal}\nrun:/' plane.yaml >along.yaml
ranked along 1 3
resumed along 30 along-1

# Three materials that meet in lines, two of them on a wall with angles: surfaces of each against all others.
cat >lens.yaml <<'END'
bulla: 1
title: a lens between two liquids
domain:
  lower: [0, -8 um]
  upper: [16 um, 8 um]
  cells: [32, 32]
  boundaries: {x-: symmetry, x+: {type: no-slip, contact-angle: {above+below: 70 deg}}, y-: reflecting, y+: reflecting}
mesh: {tile: 8, levels: 1, refine: [{interface: lens}]}
materials:
  above: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 0.5 MPa}, viscosity: 6 mPa s}
  below: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 0.5 MPa}, viscosity: 6 mPa s}
  lens: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 0.5 MPa}, viscosity: 6 mPa s}
surface-tension: {lens+above: 52 mN/m, lens+below: 60 mN/m, above+below: 72.8 mN/m}
initial:
  - {everywhere: true, material: above, density: 1000, pressure: 1 atm}
  - {half-space: {point: [0, 0], normal: [0, -1]}, material: below, density: 1000, pressure: 1 atm}
  - {sphere: {center: [0, 0], radius: 4.5 um}, material: lens, density: 1000, pressure: 1.1 atm}
run: {until: 60 ns}
output:
  history: {every: 1 step, columns: {S: {integral: surface_energy}, m: {mass: lens}, u: {max: velocity_x}, v: {max: velocity_y}}}
  checkpoints: {every: 20 steps}
expect: [{value: "max(abs(m/first(m) - 1))", at-most: 1e-13}, {value: max(u), at-least: 0.1}]
END
ranked lens 1 3
resumed lens 30 lens-1
"$BULLA" run "$BULLA_SOURCE/cases/verify/k13-lens.yaml" --variant quick -o neumann --quiet >said 2>&1 || fail "not Neumann's angles" said

# A surface that leaves the finest level: the force at the faces between levels is one on both sides.
cat >half.yaml <<'END'
bulla: 1
title: a drop half of which is fine
domain: {lower: [-20 um, -20 um], upper: [20 um, 20 um], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic}}
mesh: {tile: 8, levels: 1, refine: [{region: {box: {lower: [0, -20 um], upper: [20 um, 20 um]}}}]}
materials: {water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}, air: {eos: {type: ideal-gas, gamma: 1.4}}}
surface-tension: {water+air: 72.8 mN/m}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1 atm}
  - {sphere: {center: [0, 0], radius: 10 um}, material: water, density: 998, pressure: 1 atm, balance: tension}
run: {until: 20 ns}
output: {history: {every: 5 steps, columns: {u: {max: "= sqrt(velocity_x^2 + velocity_y^2)"}, m: {mass: water}}}}
expect: [{value: max(u), at-most: 0.1}, {value: "max(abs(m/first(m) - 1))", at-most: 1e-13}]
END
ran half half 2>said || fail "a drop on two levels" said

refused() { # WHAT SETTING...: ends with 2 and says so
    what=$1
    shift
    code=0
    "$BULLA" show bubble.yaml "$@" >said 2>&1 || code=$?
    [ "$code" -eq 2 ] || fail "$*: code $code" said
    grep -qF "$what" said || fail "$*: does not say '$what'" said
}
refused "there is no material 'ari'" --set 'surface-tension={water+ari: 0.07}'
refused "did you mean 'air'?" --set 'surface-tension={water+ari: 0.07}'
refused "'water' is no pair of materials" --set 'surface-tension={water: 0.07}'
refused "no surface tension with itself" --set 'surface-tension={air+air: 0.07}'
refused "this pair has a surface tension already" --set 'surface-tension={water+air: 0.07, air+water: 0.07}'
refused 'is a pressure' --set 'surface-tension={water+air: 72 Pa}'
refused 'surface-tension.water+air' --set 'surface-tension={water+air: -0.07}'
refused 'interfaces are flat here' --set domain.geometry=cartesian --set domain.boundaries.x-=reflecting
refused 'only a sphere is in balance' --set 'initial.0.balance=tension'
refused 'no surface tension with the one that it is painted on' --set initial.1.balance=tension --set surface-tension=null
refused 'the pressure outside of the sphere as a number' --set initial.1.balance=tension --set 'initial.1.pressure=1e5 + x'
if "$BULLA" show plane.yaml --set domain.geometry=axisymmetric --set 'domain.lower=[0, -8 um]' --set domain.boundaries.x-=axis \
    --set 'initial.1={sphere: {center: [1 um, 0], radius: 1 um}, material: air, density: 1, pressure: 1 atm, balance: tension}' \
    >said 2>&1; then fail "a ring in balance" said; fi
grep -q 'a sphere beside the axis is a ring' said || fail "the ring" said
"$BULLA" show bubble.yaml --set 'mesh.refine=[{region: {box: {lower: [0], upper: [9 um]}}}]' >said 2>&1 || true
grep -q 'nothing refines there' said || fail "no warning where the surface is coarse" said

# Traces of viscous gas near vacuum, in a film of water under tension, take no heat that moves volume: 1.4 m/s after 1 ns, not 326.
"$BULLA" run "$BULLA_SOURCE/cases/verify/k15-wall.yaml" -o film --quiet --set 'parameters.p=5 atm' --set run.until=1e-9 >film.log || true
tail -n 1 film/history.csv | awk -F, '{ exit !($2 > 9e-10 && $7 < 3) }' || fail 'fast gas in a film' film.log
