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
{ head; echo '  - {value: "max(rhoo)", at-most: 1}'; } >case.yaml
run 2
grep -q "did you mean 'rho'" stderr
