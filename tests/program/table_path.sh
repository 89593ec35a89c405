# The file of a law is found beside the case file in which its name stands, from wherever bulla is started, through `extends`
# too; one table on several ranks gives the bits of one process.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
mkdir -p laws cases/deep elsewhere
awk 'BEGIN {
    print "rho[kg/m3],T[K],p[Pa],e[J/kg],c[m/s],s[J/kg/K]"
    cv = 717.5; g = 1.4
    for (i = 0; i < 30; i++) for (j = 0; j < 25; j++) {
        rho = 0.05 * exp(i * log(400) / 29); T = 150 * exp(j * log(20) / 24)
        printf "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", rho, T, (g - 1) * cv * rho * T, cv * T, sqrt(g * (g - 1) * cv * T),
            cv * log(T) - (g - 1) * cv * log(rho)
    }
}' >laws/air.csv

cat >cases/deep/base.yaml <<'E2'
bulla: 1
title: A tube of tabulated air
about: Written by a test.
domain:
  geometry: cartesian
  lower: [0]
  upper: [1 m]
  cells: [100]
  boundaries: {x-: reflecting, x+: reflecting}
materials: {air: {eos: {type: table, file: ../../laws/air.csv}}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}
  - {box: {lower: [0], upper: [0.5 m]}, material: air, density: 2.4, pressure: 2e5}
scheme: {riemann: hllc, limiter: mc, cfl: 0.4}
run: {until: 0.3 ms}
output:
  history: {every: 1 step, columns: {p: {max: pressure}, T: {max: temperature}, e: {total: energy}}}
E2
cat >elsewhere/case.yaml <<'E2'
extends: ../cases/deep/base.yaml
run: {until: 0.5 ms}
E2
here=$PWD
cd elsewhere # not where the file is
"$BULLA" run case.yaml -o "$here/one" --quiet
cd "$here"
"$BULLA" run cases/deep/base.yaml -o two --quiet --set run.until=0.5ms -n 2
"$BULLA" run elsewhere/case.yaml -o three --quiet -n 3
cmp one/history.csv two/history.csv
cmp one/history.csv three/history.csv
grep -q "$here/laws/air.csv" one/case.yaml

refused() { # WORDS ARGS...
    words=$1
    shift
    if "$BULLA" "$@" >said 2>&1; then echo "taken: $*"; exit 1; fi
    [ "$(grep -c "$words" said)" = 1 ] || { echo "'$words' is not said once:"; cat said; exit 1; }
}
# A mistake in the file is told with both places, once, on any number of ranks.
sed '40s/^[^,]*,[^,]*,/&nan/' laws/air.csv >laws/bad.csv
sed 's/air\.csv/bad.csv/' cases/deep/base.yaml >cases/deep/bad.yaml
refused "bad.yaml:10:.*bad.csv:40: p\[Pa\] is not finite" run cases/deep/bad.yaml -o never --quiet
refused "bad.yaml:10:.*bad.csv:40: p\[Pa\] is not finite" run cases/deep/bad.yaml -o never --quiet -n 3
[ ! -e never ]
sed 's/air\.csv/none.csv/' cases/deep/base.yaml >cases/deep/none.yaml
refused "none.csv: there is no such file" check cases/deep/none.yaml
