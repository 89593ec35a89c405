# Walls that move across their face: two facing pistons in the plane are mirror images, the same bits on ranks and after a restart; a
# resting wall is what it was; a wall that recedes makes a rarefaction; which velocities are refused stands in data/case/bad.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

cat >pistons.yaml <<'END'
bulla: 1
domain:
  lower: [-1, 0]
  upper: [1, 0.5]
  cells: [32, 8]
  boundaries:
    x-: {type: reflecting, velocity: ['= 50 * math.sin(2000 * t)', 0]}
    x+: {type: no-slip, velocity: ['= -50 * math.sin(2000 * t)', 0]}
    y-: reflecting
    y+: reflecting
mesh: {tile: 8}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}
  - {sphere: {center: [0, 0.1], radius: 0.2}, material: water, density: 1000, pressure: 1e5}
run: {until: 10 ms, max-steps: 60}
output:
  directory: out
  checkpoints: {every: 20 steps}
  snapshots: {every: 60 steps, fields: [pressure]}
  history: {columns: {p: {max: pressure}}}
expect:
  - {norm: Linf, field: pressure, reference: mirror-x, at-most: 0}
  - {value: "max(p)", at-least: 1.1e5}
END
ranked pistons 1 2 3
resumed pistons 20 pistons-1

# Simple wave: behind a wall that leaves with U, p = p0 (1 - (gamma - 1)/2 U/c)^7.
cat >leaves.yaml <<'END'
bulla: 1
domain: {lower: [0], upper: [1], cells: [200], boundaries: {x-: {type: no-slip, velocity: [-100]}, x+: reflecting}}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial: [{everywhere: true, material: air, density: 1.4, pressure: 1e5}]
run: {until: 2 ms}
output: {directory: out, snapshots: {every: 2 ms}, probes: {wall: {at: [0.1], fields: [pressure, velocity_x]}}}
expect:
  - {value: "last(wall.pressure) / (1e5 * (1 - 0.2 * 100 / math.sqrt(1e5))^7)", equals: 1, tolerance: 0.002} # c^2 = 1.4 p / rho
  - {value: "last(wall.velocity_x)", equals: -100, tolerance: 0.3}
END
ran leaves leaves
