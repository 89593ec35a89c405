# What is wrong, or doubtful, about viscosity, heat and surface tension: refused with its line and a remedy, or warned of, each
# beside the same scene without it, which is silent. What `check` says of them: Reynolds and Laplace numbers, layers,
# steps by level, the real fluid's heat capacity, faces for slow flow. A hot bubble beside water in tension, whose gas
# has a law that grows with temperature, goes through.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >walk.yaml <<'E'
bulla: 1
title: A warm bubble on a cold wall
domain:
  lower: [0, 0]
  upper: [32 um, 32 um]
  cells: [32, 32]
  boundaries: {x-: reflecting, x+: reflecting, y-: {type: no-slip, contact-angle: {water+air: 60 deg}}, y+: symmetry}
mesh: {levels: 1, refine: [{interface: air}]}
materials:
  water: {eos: {type: nasg, preset: water}, viscosity: 0.89 mPa s, conductivity: 0.607 W/m/K}
  air: {eos: {type: ideal-gas, preset: air}, viscosity: {type: sutherland, preset: air}, conductivity: {type: sutherland, preset: air}}
surface-tension: {water+air: 72.8 mN/m}
initial:
  - {everywhere: true, material: water, temperature: 300 K, pressure: 1 atm}
  - {sphere: {center: [15.3 um, 0], radius: 7 um}, material: air, temperature: 600 K, pressure: 0.2 atm}
run: {until: 1 us, max-steps: 150}
E
"$BULLA" show walk.yaml >shown 2>said || fail "refused" said
[ ! -s said ] || fail "a false alarm" said

refuse() { # PATTERN HELP ARGS...: an error and its remedy
    pattern=$1 help=$2
    shift 2
    code=0
    "$BULLA" show walk.yaml "$@" >shown 2>said || code=$?
    [ "$code" = 2 ] || fail "exit code $code: $*" said
    grep -qF -- "$pattern" said || fail "not said, '$pattern': $*" said
    grep -q -- "$help" said || fail "no help, '$help': $*" said
}
doubt() { # PATTERN HELP ARGS...: one warning and its remedy
    pattern=$1 help=$2
    shift 2
    "$BULLA" show walk.yaml "$@" >shown 2>said || fail "refused: $*" said
    [ "$(grep -c ': warning: ' said)" = 1 ] || fail "not one warning: $*" said
    grep -qF -- "$pattern" said || fail "not said, '$pattern': $*" said
    grep -q -- "$help" said || fail "no help, '$help': $*" said
}

# Pairs that are not there, or are none.
refuse "there is no material 'oil'" "did you mean 'air'" --set 'surface-tension={water+oil: 1 mN/m}'
refuse "'water' is no pair of materials" 'two names with a +' --set 'surface-tension={water: 1 mN/m}'
refuse "no surface tension with itself" '' --set 'surface-tension={air+air: 1 mN/m}'
refuse "there is no material 'oil'" "did you mean 'air'" --set 'domain.boundaries.y-={type: no-slip, contact-angle: {water+oil: 60 deg}}'
refuse "this pair has no surface tension, so nothing makes it keep an angle" 'surface-tension: {water+air' --set surface-tension=null
# Numbers below 0, or of another kind.
refuse "-0.001 N/m is not above 0" '' --set 'surface-tension={water+air: -1 mN/m}'
refuse "'1 Pa' is a pressure, but a surface tension is needed" 'N/m' --set 'surface-tension={water+air: 1 Pa}'
refuse "-1 Pa s is outside 0 to" '' --set materials.water.viscosity=-1
refuse "-1 Pa s is outside 0 to" '' --set 'materials.water.viscosity={type: newtonian, mu: 1, zeta: -1}'
refuse "'1 mN/m' is a surface tension, but a dynamic viscosity is needed" 'Pa\*s' --set 'materials.water.viscosity=1 mN/m'
refuse "-1 W/m/K is outside 0 to" '' --set materials.water.conductivity=-1
refuse "'1 Pa s' is a dynamic viscosity, but a heat conductivity is needed" 'W/m/K' --set 'materials.water.conductivity=1 Pa s'
refuse "60 deg is no angle" '' --set 'domain.boundaries.y-={type: no-slip, contact-angle: {water+air: 260 deg}}'
refuse "3437.75 deg is no angle of contact" "did you mean '60 deg'" --set 'domain.boundaries.y-={type: no-slip, contact-angle: {water+air: 60}}'
# What sets the time step of laws without a largest viscosity of their own.
refuse "key 'regularisation' is missing" 'the viscosity at rest, .* sets the time step' \
    --set 'materials.water.viscosity={type: herschel-bulkley, yield-stress: 10, consistency: 1, index: 1}'
refuse "key 'regularisation' is missing" 'viscosity at rest' --set 'materials.water.viscosity={type: casson, yield-stress: 10, mu: 1}'
refuse "key 'mu-max' is missing" 'the time step goes by it' --set 'materials.water.viscosity={type: power, consistency: 1, index: 0.5}'
# Angles where fluids slip; a surface without a second material; heat without temperatures.
for type in reflecting symmetry outflow; do
    refuse "unknown key 'contact-angle'" "a key of 'type: no-slip'" --set "domain.boundaries.y-={type: $type, contact-angle: {water+air: 60 deg}}"
done
refuse "surface tension is between two materials, and there is one" '' --set materials.air=null
refuse "'water' conducts heat, but its law stiffened-gas has no temperatures" "give 'cv'" \
    --set 'materials.water.eos={type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}'

# Doubts.
doubt "without any viscosity a no-slip wall stops only what the faces of the scheme smear" "'reflecting' lets fluids slip" \
    --set materials.water.viscosity=null --set materials.air.viscosity=null
doubt "surface tension acts where materials meet, but nothing refines there" '{interface: air}' \
    --set 'mesh.refine=[{jump: pressure, above: 0.1}]'
doubt "temperatures of interfaces come out wrong with 'fast'" "leave it out" --set scheme.exchange=fast

# What `check` says.
"$BULLA" check walk.yaml >said 2>&1 || fail "check" said
says() { grep -q -- "$1" said || fail "check does not say: $1" said; }
says 'laplace number water [0-9.e+]*, air [0-9.e+]*: in the sphere of initial\[1\], 7 um'
says 'steps of its waves: 33.87 ns on level 0 (sound allows 0.00[0-9]* of that), 11.98 ns on level 1'
says 'asks for 10.4 kPa more in the sphere of initial\[1\], which begins with -81.06 kPa more'
says 'conducts 26.* cp 1005 J/kg/K (air: 1006): diffusivity'
says 'cp 4.* J/kg/K (water: 4181): diffusivity'
says 'layers grow to .* of the finest cells'
says 'its steps: .* on level 0 (sound allows .* on level 1 (sound allows'
says 'jumps between cells are damped by up to'
says '^  reynolds  *water [0-9.e+]*, air [0-9.e+]*: flow of '
! grep -q 'slow flow' said || fail "49 m/s are not slow" said
laplace() { sed -n 's/.*laplace number water \([0-9.e+]*\),.*/\1/p' said; }
awk "BEGIN { La = 72.8e-3 * 1051 * 7e-6 / 0.89e-3^2; r = $(laplace) / La; exit !(r > 0.9 && r < 1.1) }" || fail "not sigma rho R/mu^2" said
slow='--set initial.1.pressure=101325 --set initial.1.temperature=320'
"$BULLA" check walk.yaml $slow >said 2>&1
says "^  slow flow  *flow of 0.0[0-9]* of the slowest speed of sound: with 'scheme: {low-mach: 0.05}'"
! grep -q '^  low-mach' said || fail "all of a jump is no part of it"
"$BULLA" check walk.yaml $slow --set scheme.low-mach=0.05 --set 'materials.water.viscosity={type: carreau, preset: blood}' >said 2>&1
! grep -q 'slow flow' said || fail "low-mach is there" said
says 'viscosity at most 56 mPa s'
"$BULLA" check walk.yaml --set 'initial.1={half-space: {point: [0, 1 um], normal: [0, -1]}, material: air, pressure: 1 atm, temperature: 300 K}' >said 2>&1
says 'over the shortest side, 32 um'
"$BULLA" check walk.yaml --set 'materials.tissue={eos: {type: stiffened-gas, preset: sg44}, constitutive: {type: neo-hookean, shear-modulus: 100 kPa, reference-density: 1000}}' >said 2>&1 || fail "tissue" said
says '^  sticks  *water, air to solids'
"$BULLA" check walk.yaml --set 'domain={geometry: spherical, lower: [0], upper: [32 um], cells: [64], boundaries: {x-: axis, x+: reflecting}}' \
    --set 'initial.1.sphere={center: [0], radius: 7 um}' >said 2>&1 || fail "spherical" said
says '^  low-mach  *0.05 of a jump of velocity' # by itself
! grep -q 'slow flow' said || fail "bubbles have low-mach by themselves"
says 'laplace number'
! grep -q 'steps of its waves' said || fail "in one dimension surfaces do not bend" said

# Gas that cools draws the water into tension; where it has all but left a cell it is thin and hot, and Sutherland's law makes it
# viscous: without a bound its own friction ended this run after 120 steps.
"$BULLA" run walk.yaml -o tension --set mesh.levels=0 --set 'mesh.refine=[]' --quiet \
    --set 'output={history: {every: 1 step, columns: {p: {min: pressure}, P: {max: pressure}}}}' \
    --set 'expect=[{value: min(p), at-most: -1e4}, {value: max(P), at-most: 5e6}]' >said 2>&1 || fail "the bubble in tension" said

# Surfaces have thin fronts: thinc is the default.
"$BULLA" check "$BULLA_SOURCE/cases/verify/k8-mode2.yaml" | grep -q '^  interface *limiter:thinc' || fail "thinc is not the default"
"$BULLA" check "$BULLA_SOURCE/cases/tour/shock-bubble.yaml" --set 'surface-tension={}' 2>&1 |
    grep -q '^  interface *limiter:superbee' || fail "no pair, and thinc"
"$BULLA" check "$BULLA_SOURCE/cases/verify/k2-small.yaml" | grep -q '^  interface *limiter:superbee' || fail "around a centre surfaces stay round"
exit 0
