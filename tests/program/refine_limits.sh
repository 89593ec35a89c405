# Refinement that asks for more than it may, or for nothing: a run that a regrid would take beyond --max-memory stops
# whole, with a checkpoint that more memory can go on from; a criterion that tags nothing is named at the end.
set -eu
cat >grow.yaml <<'CASE'
bulla: 1
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}
mesh:
  levels: 2
  refine:
    - {jump: density, above: 0.01 kg/m3}
    - {jump: pressure, above: 3 MPa, finest: 1}
materials: {gas: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: gas, density: 0.125, pressure: 0.1}
  - {sphere: {center: [0.5, 0.5], radius: 0.1}, material: gas, density: 1, pressure: 1}
scheme: {cfl: 0.4}
run: {until: 0.15}
output: {directory: out, history: {every: 1 step, columns: {mass: {total: mass}}}}
CASE
fail() {
    echo "$*" >&2
    exit 1
}

code=0
"$BULLA" run grow.yaml --max-memory 1500KiB >said 2>&1 || code=$?
[ "$code" -eq 3 ] || fail "a regrid beyond the limit ended with $code: $(cat said)"
grep -q 'refinement asks for .* tiles, .* but may take .* (--max-memory' said || fail "no reason: $(cat said)"
ls out/checkpoints/*.chk >/dev/null || fail "no checkpoint was left"
"$BULLA" run grow.yaml --restart >said 2>&1 || fail "the run did not go on: $(cat said)"
grep -q 'mesh.refine\[1\] (line 7): .* has not tagged a single cell' said || fail "the idle criterion goes unnamed: $(cat said)"
if grep -q 'mesh.refine\[0\]' said; then fail "a criterion that tags is complained about"; fi

# A domain that no machine has the memory for is a mistake in the case: said at once, before anything is taken or written.
for ranks in 1 2; do
    code=0
    "$BULLA" run grow.yaml -o vast --set 'domain.cells=[1600000, 1600000]' -n $ranks >said 2>&1 || code=$?
    [ "$code" -eq 2 ] || fail "an impossible domain ended with $code: $(cat said)"
    grep -q 'error: .*the coarsest level alone, 2.56e+12 cells, takes .* TiB, but there are only .* here' said ||
        fail "no sizes: $(cat said)"
    [ "$(grep -c error said)" = 1 ] || fail "said more than once: $(cat said)"
    [ ! -e vast ] || fail "something was written"
done
"$BULLA" check grow.yaml --set 'domain.cells=[1600000, 1600000]' >said
grep -q '^  memory .* TiB: more than this machine has, ' said || fail "check does not say so: $(cat said)"

# Nor does a limit of the process end in the middle of something.
code=0
if case ${ASAN_OPTIONS-} in *log_path*) false ;; esac; then # sanitizers ask for terabytes of addresses
    (ulimit -v 1000000 && "$BULLA" run grow.yaml -o vast --set 'domain.cells=[8000, 8000]' >said 2>&1) || code=$?
    [ "$code" -eq 2 ] || fail "a domain beyond ulimit -v ended with $code: $(cat said)"
    grep -q 'there are only 977 MiB here' said || fail "$(cat said)"
fi
