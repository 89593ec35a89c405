# expect: norms of fields with known values, the table for people, expect.json, exit codes.
set -eu
cat >line.csv <<'END'
# a straight line and a jump; columns: x[m], y, step (1 above 0.5)
0,0,0
0.5,0.5,0
0.5,0.5,1
1,1,1
END
head() {
    cat <<'END'
bulla: 1
domain: {lower: [0], upper: [1], cells: [16], boundaries: {x-: periodic, x+: periodic}}
materials: {gas: {eos: {type: ideal-gas, gamma: 1.4}}}
initial: [{everywhere: true, material: gas, density: 1, pressure: 1}]
run: {until: 0.1}
output: {directory: out, snapshots: {every: 0.1, fields: [density, velocity], precision: double},
         history: {columns: {rho: {max: density}}}, probes: {p: {at: [0.25], fields: [pressure]}}}
expect:
END
}
run() { # CODE: runs case.yaml
    got=0
    "$BULLA" run case.yaml --overwrite >stdout 2>stderr || got=$?
    [ "$got" = "$1" ] || { echo "exit code $got, wanted $1"; cat case.yaml stdout stderr; exit 1; }
}
# Cells of 1/16: mean |1 - x| = 1/2, the largest is 1 - 1/32, the mean square 1/3 - h^2/12.
{
    head
    cat <<'END'
  - {norm: L1, field: density, reference: line.csv, column: y, equals: 0.5, tolerance: 1.0e-14}
  - {norm: Linf, field: density, reference: line.csv, column: y, equals: 0.96875, tolerance: 1.0e-14}
  - {norm: L2, field: density, reference: line.csv, column: y, equals: 0.577068291, tolerance: 1.0e-10}
  - {norm: L1, field: density, reference: line.csv, column: step, scale: 0.25, equals: 2, tolerance: 1.0e-13}
  - {norm: L1, field: velocity_x, reference: line.csv, column: y, equals: 0.5, tolerance: 1.0e-14}
  - {norm: Linf, field: density, reference: initial, at-most: 1.0e-14, label: stays as it was}
  - {value: "max(rho) + last(p.pressure)", equals: 2, tolerance: 1.0e-13}
END
} >case.yaml
run 0
[ "$(grep -c '^ *pass' stdout)" = 7 ]
grep -q 'stays as it was' stdout
grep -q '"passed": true' out/expect.json

# One that fails: exit 1, and the others are judged too.
{ head; echo '  - {value: "max(rho)", at-most: 0.5}'; echo '  - {value: "min(rho)", at-least: 0.5}'; } >case.yaml
run 1
grep -q '^ *FAIL  max(rho)' stdout
grep -q '^ *pass  min(rho)' stdout

# Nonsense: exit 2 with the line of the case file and what there is.
{ head; echo '  - {norm: L1, field: density, reference: line.csv, column: z, at-most: 1}'; } >case.yaml
run 2
grep -q 'case.yaml:9' stderr
grep -q "no column 'z'; it has x y step" stderr
{ head; echo '  - {norm: L1, field: density, reference: exact-riemann, at-most: 1}'; } >case.yaml
run 2
grep -q 'two layers that meet at one point' stderr

# Expressions are Lua over whole columns, checked before anything is run: no output directory is made.
rm -rf out
for wrong in 'max(rhoo):18:did you mean .rho.' 'mxa(rho):14:did you mean .max.' 'max(p.presure):18:mean .p.pressure.' \
    'max(2):14:max: a column of the run is needed, not a number' 'at(rho, rho):14:a time is needed' 'rho:14:whole column'; do
    { head; echo "  - {value: \"${wrong%%:*}\", at-most: 1}"; } >case.yaml
    rest=${wrong#*:}
    run 2
    grep -q "^case.yaml:9:${rest%%:*}: error: expect\[0\].value: " stderr || { cat stderr; exit 1; }
    grep -q "${rest#*:}" stderr || { cat stderr; exit 1; }
    got=0
    "$BULLA" check case.yaml >stdout 2>stderr || got=$?
    [ "$got" = 2 ]
    [ ! -e out ]
done

# What the check takes for a column is one, and pi is pi wherever a formula can stand.
{
    head | sed 's/fields: \[pressure\]}/fields: [pressure, velocity, vorticity, temperature]}/; s/density: 1, pressure: 1}/density: = 1 + pi - math.pi, pressure: "= cos0 * (1 + 0 * x * pi)"}/
        s/^bulla: 1/&\nparameters: {cos0: = math.cos(2 * pi) + pi - math.pi}/; s/rho: {max: density}/&, c: {value: "rho * pi"}, d: {value: "rho * math.pi"}/' |
        sed 's/gamma: 1.4/&, cv: 718/'
    cat <<'END'
  - {value: "max(p.pressure + p.velocity_x + p.velocity_y + p.velocity_z)", equals: 1, tolerance: 1.0e-13}
  - {value: "max(abs(p.vorticity_x + p.vorticity_y + p.vorticity_z)) + 0 * max(p.temperature)", equals: 0, tolerance: 1.0e-13}
  - {value: "last(t) - last(step) * 0 + 0 * max(dt + guard_fallback + guard_relaxed + guard_clipped + guard_retries)", equals: 0.1, tolerance: 1.0e-13}
  - {value: "max(abs(c - d)) + pi - math.pi", equals: 0, tolerance: 0}
  - {value: "max(math.sin(pi * t)) > 0.3 and cos0 or 2", equals: 1, tolerance: 1.0e-13}
END
} >case.yaml
run 0
[ "$(grep -c '^ *pass' stdout)" = 5 ]

# What only the run can tell: the expectation fails and says why, the others are judged, and there is an expect.json.
{ head; echo '  - {value: "at(rho, 5)", at-most: 2}'; echo '  - {value: "1/(max(rho) - max(rho))", at-most: 2}'; echo '  - {value: "max(rho)", at-most: 2}'; } >case.yaml
run 1
grep -q '^warning: case.yaml:9: expect: .at(rho, 5)., character 1: at: the run has no such time: 5.0 is outside of 0.0 to 0.1$' stderr
[ "$(grep -c '^ *FAIL' stdout)" = 2 ]
[ "$(grep -c '^ *pass' stdout)" = 1 ]
grep -q '"fault": "case.yaml:9: ' out/expect.json

# Mirror images: the same bits on both sides, or not; a vector turns round; an axis that is not there is a mistake.
mirror() { # CENTRE
    cat <<END2
bulla: 1
domain: {lower: [-1, -1], upper: [1, 1], cells: [16, 16], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}
materials: {gas: {eos: {type: ideal-gas, gamma: 1.4}}}
initial: [{everywhere: true, material: gas, density: 1, pressure: 1}, {sphere: {center: [0, $1], radius: 0.4}, pressure: 3}]
mesh: {tile: 8, levels: 1, refine: [{jump: pressure, above: 0.2}]}
scheme: {cfl: 0.4}
run: {until: 0.2}
output: {directory: out, snapshots: {every: 0.2, fields: [density, velocity], precision: double}}
expect:
END2
}
{ mirror 0
  for axis in x y; do
      for field in density velocity_x velocity_y; do echo "  - {norm: Linf, field: $field, reference: mirror-$axis, at-most: 0}"; done
  done
} >case.yaml
run 0
{ mirror 0.1
  for axis in x y; do echo "  - {norm: L1, field: density, reference: mirror-$axis, at-most: 0}"; done
} >case.yaml
run 1
[ "$(grep -c '^ *pass' stdout)" = 1 ]
{ mirror 0; echo '  - {norm: L1, field: density, reference: mirror-z, at-most: 0}'; } >case.yaml
run 2
grep -q "'mirror-z' needs a field of the snapshots and that axis" stderr
