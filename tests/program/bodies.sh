# Rigid bodies: fluids flow around them, they stand still or move as prescribed. The same bits on 1, 2 and 3 ranks and after a
# restart, with levels; a closed box with bodies at rest keeps mass and energy to round-off, with two materials; a mirrored scene is
# a mirror image; fluid at rest and flow along a slanted wall stay what they are; nobody pushes a body in fluid at rest.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

# A shock meets a disc and a slanted box in a closed box of water with a bubble of air.
cat >closed.yaml <<'END'
bulla: 1
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8, levels: 1, refine: [{jump: pressure, above: 5 MPa}]}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
bodies:
  disc: {sphere: {center: [0.5, 0.48], radius: 0.17}}
  box: {rotated: {shape: {box: {lower: [0.75, 0.5], upper: [0.9, 0.8]}}, angle: 20 deg, about: [0.8, 0.7]}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 1e5}
  - {sphere: {center: [0.4, 0.75], radius: 0.1}, material: air, density: 1.2, pressure: 1e5}
  - {box: {lower: [0, 0], upper: [0.2, 1]}, material: water, density: 1020, pressure: 50e6}
run: {until: 1 ms, max-steps: 60}
output:
  directory: out
  checkpoints: {every: 20 steps}
  snapshots: {every: 60 steps, fields: [pressure, body]}
  history: {columns: {w: {mass: water}, a: {mass: air}, E: {total: energy}, f: {force: disc, along: x}, p: {max: pressure}}}
expect:
  - {value: "max(abs(w/first(w) - 1))", at-most: 1e-13}
  - {value: "max(abs(a/first(a) - 1))", at-most: 1e-12}
  - {value: "max(abs(E/first(E) - 1))", at-most: 1e-13}
  - {value: "max(f)", at-least: 1e6}
END
ranked closed 1 2 3
resumed closed 20 closed-1
"$BULLA" plan closed.yaml >plan
grep -q '^  bodies .*: disc, box .*core/scheme/cut.c' plan || fail 'the plan does not name the bodies' plan

# Two discs that swing towards each other and turn: mirror images, with levels; nothing leaves but what the way of a step costs.
cat >swing.yaml <<'END'
bulla: 1
parameters: {w: 3000}
domain: {lower: [-1, 0], upper: [1, 0.5], cells: [64, 16], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8, levels: 1}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
bodies:
  left: {sphere: {center: [-0.5, 0.25], radius: 0.1}, displacement: ['= 0.04 * (1 - math.cos(w * t))', 0]}
  right: {sphere: {center: [0.5, 0.25], radius: 0.1}, displacement: ['= -0.04 * (1 - math.cos(w * t))', 0]}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}
  - {union: [{sphere: {center: [-0.5, 0.25], radius: 0.075}}, {sphere: {center: [0.5, 0.25], radius: 0.075}}], material: air, density: 5, pressure: 1e6}
run: {until: 2 ms, max-steps: 60}
output:
  directory: out
  checkpoints: {every: 20 steps}
  snapshots: {every: 60 steps, fields: [pressure, body]}
  history: {columns: {m: {total: mass}, l: {force: left, along: x}, r: {force: right, along: x}}}
expect:
  - {norm: Linf, field: pressure, reference: mirror-x, scale: 1e5, at-most: 1e-12}
  - {value: "max(abs(m/first(m) - 1))", at-most: 8e-6}
  - {value: "max(abs(l + r))", at-most: 1e-7}
  - {value: "max(abs(l))", at-least: 1e3}
END
ranked swing 1 2 3
resumed swing 20 swing-1

# When a run is to end is nothing that bodies know: it goes on beyond its end as one that was to go there at once, to the bit.
cat >later.yaml <<'END'
bulla: 1
domain: {lower: [-1, 0], upper: [1, 0.5], cells: [64, 16], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8, levels: 1}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
bodies:
  goes: {sphere: {center: [-0.53, 0.25], radius: 0.1}, velocity: [37, 3]}
  swings: {box: {lower: [0.31, 0.2], upper: [0.5, 0.31]}, displacement: ['= 0.03 * math.sin(3100 * t)', 0], angle: '= 90 * t', pivot: [0.4, 0.25]}
initial: [{everywhere: true, material: air, density: 1.2, pressure: 1e5}]
run: {until: 0.06 ms}
output:
  directory: out
  checkpoints: {every: 0.02 ms}
  snapshots: {every: 0.02 ms, fields: [pressure, body]}
  history: {columns: {m: {total: mass}, g: {force: goes, along: x}, s: {force: swings, along: x}}}
END
ran later-straight later
ran later-first later --until 0.02ms
mkdir later-on
cp -r later-first/out later-on/out
ran later-on later --restart
cmp later-straight/out/history.csv later-on/out/history.csv
last=$(ls later-straight/out/fields/later_*.hdf | tail -1)
"$BULLA_BUILD/tests/test-unit-snapshot" "$last" "later-on/out/fields/${last##*/}"

# A piston: where it is and how fast, in the history; what fluids work on it is force times velocity, and what they gain of energy;
# the run says what mass its way has cost, a quarter with half the steps.
cat >piston.yaml <<'END'
bulla: 1
domain: {lower: [0], upper: [1], cells: [100], boundaries: {x-: reflecting, x+: reflecting}}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
bodies: {p: {box: {lower: [-0.1], upper: [0.2]}, displacement: ['= 0.05 * (1 - math.cos(2000 * t))']}}
initial: [{everywhere: true, material: air, density: 1.2, pressure: 1e5}]
run: {until: 3 ms}
output:
  directory: out
  history: {columns: {E: {total: energy}, f: {force: p}, P: {power: p}, x: {body-displacement: p}, u: {body-velocity: p}}}
END
ran piston piston
awk -F, 'NR == 1 { if ($0 !~ /^step,t,dt,E,f,P,x,u,/) bad = 1; next }
         function off(a, b, most) { d = a - b; if (d > most || d < -most) { print "step " $1 ": " a " for " b; bad = 1 } }
         { off($7, 0.05 * (1 - cos(2000 * $2)), 1e-15); off($8, 100 * sin(2000 * $2), 1e-6); off($6, $5 * $8, 1e-6)
           if (NR > 2) work += ($2 - t) * ($6 + P) / 2; else first = $4
           t = $2; P = $6 }
         END { off($4 - first, -work, 2e-5 * first); exit bad }' piston/out/history.csv || fail 'the piston'
grep -q 'bodies that move: the mass of the fluids has changed by 6.5e-06 of itself' piston/out/log.txt || fail 'the mass is not told' piston/out/log.txt
ran piston-half piston --set scheme.cfl=0.2
grep -q 'changed by 1.6e-06 of itself' piston-half/out/log.txt || fail 'not of second order' piston-half/out/log.txt
"$BULLA" check piston.yaml >said
grep -q 'bodies  *p: moves with up to 99.97 m/s' said || fail 'how it goes is not told' said
sed 's/gamma: 1.4}/preset: air}, viscosity: 1 mPa.s, conductivity: 0.026/' piston.yaml >sticky.yaml
"$BULLA" check sticky.yaml >/dev/null 2>said
grep -q "sticky.yaml:4:9: warning: bodies: 'air' is viscous, but fluids slip along bodies" said || fail 'no warning of friction' said
grep -q "'air' conducts heat, but none passes the walls of bodies" said || fail 'no warning of heat' said
sed 's/{body-velocity: p}/{body-velocity: p, in: air}/' piston.yaml >part.yaml

"$BULLA" check part.yaml >/dev/null 2>said && fail 'a part of a body went through'
grep -q "a column of a body is of all of it" said || fail 'wrong message' said

# Still: rest stays rest; what goes along a wall goes on.
cat >still.yaml <<'END'
bulla: 1
parameters: {U: 0, turn: 0.47}
domain: {lower: [0, 0], upper: [1, 1], cells: [24, 24], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
bodies: {ramp: {half-space: {point: [0.5, 0.31], normal: ['= math.sin(turn)', '= -math.cos(turn)']}}}
initial: [{everywhere: true, material: air, density: 1.2, pressure: 1e5, velocity: ['= U * math.cos(turn)', '= U * math.sin(turn)']}]
run: {until: 1 ms}
output: {directory: out, history: {columns: {a: {min: pressure}, b: {max: pressure}}}}
expect:
  - {value: "max(b)/1e5 - 1", at-most: 1e-9}
  - {value: "1 - min(a)/1e5", at-most: 1e-9}
END
ran rest still
ran along still --set parameters.U=300

cat >alone.yaml <<'END'
bulla: 1
domain: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [16, 16, 16], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting, z-: reflecting, z+: reflecting}}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
bodies: {ball: {sphere: {center: [0.52, 0.47, 0.5], radius: 0.27}}}
initial: [{everywhere: true, material: air, density: 1.2, pressure: 1e5}]
run: {until: 1 ms, max-steps: 5}
output: {directory: out, history: {columns: {x: {force: ball, along: x}, y: {force: ball, along: y}, z: {force: ball, along: z}, V: {volume: air}}}}
expect:
  - {value: "max(abs(x)) + max(abs(y)) + max(abs(z))", at-most: 1e-9}
  - {value: "last(V) + 4/3 * math.pi * 0.27^3", equals: 1, tolerance: 1e-6}
END
ran alone alone

# Thin parts of a body across tiles: what each tile fills them with is its own affair, what flows is not.
cat >thin.yaml <<'END'
bulla: 1
domain: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [16, 16, 16], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting, z-: reflecting, z+: reflecting}}
mesh: {tile: 4}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
bodies: {ball: {sphere: {center: [0.6, 0.52, 0.45], radius: 0.2}}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}
  - {half-space: {point: [0.3, 0, 0], normal: [-1, 0, 0]}, material: air, density: 10, pressure: 3e6}
run: {until: 1 ms, max-steps: 20}
output: {directory: out, history: {columns: {m: {total: mass}, E: {total: energy}}}}
expect:
  - {value: "max(abs(m/first(m) - 1))", at-most: 1e-13}
  - {value: "max(abs(E/first(E) - 1))", at-most: 1e-13}
END
ran thin thin

# Drops in a wind beside a rock: water that is pressed against a wall does not press as hard on the air beside it, and walls take
# no air from cells that have none. One scene that first ended for the one, and one for the other.
cat >drop.yaml <<'END'
bulla: 1
parameters: {bx: 2.4, by: 2.4, br: 0.72, dx: 3.7, dy: 2.15, dr: 1.4, du: 29, dv: 84, wu: -94, wv: 81}
domain: {lower: [0, 0], upper: [4.8 mm, 2.4 mm], cells: [32, 16], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
bodies: {rock: {sphere: {center: [= bx/1000, = by/1000], radius: = br/1000}}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5, velocity: [= wu, = wv]}
  - {sphere: {center: [= dx/1000, = dy/1000], radius: = dr/1000}, material: water, density: 1000, pressure: 1e5, velocity: [= du, = dv]}
run: {until: 1 ms, max-steps: 100}
output: {directory: out, history: {columns: {w: {mass: water}, a: {mass: air}, E: {total: energy}}}}
expect:
  - {value: "max(abs(w/first(w) - 1))", at-most: 1e-13}
  - {value: "max(abs(a/first(a) - 1))", at-most: 1e-12}
  - {value: "max(abs(E/first(E) - 1))", at-most: 1e-13}
END
ran drop drop
parameters=
for value in bx=2.261 by=0.7713 br=0.4491 dx=3.11 dy=1.918 dr=1.441 wu=254 wv=150 du=-34.9 dv=-87.6; do
    parameters="$parameters --set parameters.$value"
done
ran blown drop $parameters
