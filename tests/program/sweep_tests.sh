# cases/matrix.yaml as tests: what the list says is what ctest gets, and mistakes in it end the build with their place.
set -eu
list() { "$BULLA_BUILD/tests/test-cases" "$1" /bin/bulla /runs 'A=1;B=2' "$BULLA_SOURCE/cases" tour/tube.yaml verify/r01.yaml verify/r02_b.yaml; }
cat >good.yaml <<'END'
tests:
  - {label: quick, cases: ["*/*"]}
  - {label: many, cases: ["verify/*", verify/r01], variant: fine, ranks: [1, 3], matrix: {scheme.limiter: [mc, minmod], domain.cells: [[8, 4]]}}
  - {label: strict, cases: [tour/tube], matrix: {scheme.guard: [strict]}}
END
list good.yaml >tests.cmake
grep '^add_test' tests.cmake | sed 's/add_test(\[==\[\([^]]*\)].*/\1/' >names
cat >wanted <<'END'
case-tour-tube
case-verify-r01
case-verify-r02-b
case-verify-r01.limiter=mc,variant=fine,ranks=1
case-verify-r01.limiter=mc,variant=fine,ranks=3
case-verify-r01.limiter=minmod,variant=fine,ranks=1
case-verify-r01.limiter=minmod,variant=fine,ranks=3
case-verify-r02-b.limiter=mc,variant=fine,ranks=1
case-verify-r02-b.limiter=mc,variant=fine,ranks=3
case-verify-r02-b.limiter=minmod,variant=fine,ranks=1
case-verify-r02-b.limiter=minmod,variant=fine,ranks=3
case-tour-tube.strict
END
diff wanted names
grep -qF -- "/cases/verify/r01.yaml]==] --variant [==[fine]==] --quiet --overwrite -o [==[/runs/case-verify-r01.limiter=minmod,variant=fine,ranks=3]==] -n 3 --set [==[scheme.limiter=minmod]==] --set [==[domain.cells=[8, 4]]==])" tests.cmake
grep -qF -- 'PROPERTIES ENVIRONMENT [==[A=1;B=2]==] LABELS [==[case;verify;many]==] TIMEOUT 1800 PROCESSORS 3)' tests.cmake

refused() { # TEXT, then a file on stdin
    cat >bad.yaml
    code=0
    list bad.yaml >tests.cmake 2>said || code=$?
    [ $code = 2 ] && grep -qF -- "$1" said || { echo "exit code $code, '$1' not said"; cat bad.yaml said; exit 1; }
}
echo 'tests: [{label: a, cases: [tour/tub]}]' | refused "bad.yaml:1:28: error: tests[0].cases[0]: there is no case 'tour/tub'"
echo 'tests: [{label: a, case: [tour/tube]}]' | refused "did you mean 'cases'"
echo 'tests: [{label: a, cases: [tour/tube], ranks: [0]}]' | refused 'ranks[0]'
echo 'tests: [{label: a, cases: [tour/tube], matrix: {scheme.cfl: 0.1}}]' | refused 'a list of values is needed'
echo 'tests: [{label: a, cases: [tour/tube]}, {label: b, cases: [tour/*]}]' | refused "'b' makes the test case-tour-tube, which another entry has made"
echo 'tests: 3' | refused 'tests'
code=0
list nowhere.yaml >tests.cmake 2>said || code=$?
[ $code = 2 ]

# The list that this build uses has every case file in it.
for file in "$BULLA_SOURCE"/cases/*/*.yaml; do
    grep -qE '^(domain|extends):' "$file" || continue
    grep -qF "add_test([==[case-$(basename "$(dirname "$file")")-$(basename "$file" .yaml | tr _ -)]==]" "$BULLA_BUILD/tests/case_tests.cmake" || { echo "$file has no test"; exit 1; }
done
