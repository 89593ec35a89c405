# Cases of solids: the check tells law, modulus and shear speed; a solver of fluids and an exact solution of fluids are
# refused; a shear wave along a line runs and keeps its momentum.
set -eu
good=$BULLA_SOURCE/tests/data/case/good

run() { # wanted exit code, then arguments
    wanted=$1
    shift
    code=0
    "$BULLA" "$@" >out.txt 2>err.txt || code=$?
    [ "$code" -eq "$wanted" ] || { echo "bulla $*: exit $code, not $wanted"; cat out.txt err.txt; exit 1; }
}

run 0 check "$good/solid-shear-line.yaml"
grep -q '^  domain .*; velocities with 2 components$' out.txt
grep -q '^  fields  *8: .* stretch_xx stretch_yy stretch_zz stretch_xy$' out.txt
grep -q '^  *constitutive:neo-hookean  shear-modulus 85000 Pa  reference-density 1060 kg/m3$' out.txt
grep -q '^  *a solid: shear modulus 85 kPa at 1060 kg/m3, shear waves at 8.955 m/s$' out.txt
grep -q '^  riemann  *riemann:hlld$' out.txt
run 0 check "$good/minimal.yaml"
grep -q '^  riemann  *riemann:hllc$' out.txt

run 0 plan "$good/solid-shear-line.yaml"
grep -q 'tissue: stiffened-gas + neo-hookean' out.txt

# A quarter of a period of a wave that travels: it keeps its momentum and, nearly, its height of 0.0895 m/s.
run 0 run "$good/solid-shear-line.yaml" -o wave --set run.until='= 0.25e-2 / c' --set 'domain.cells=[32]' \
    --set 'output.snapshots=null' --set 'output.history.columns={side: {total: momentum_y}, v: {max: velocity_y}}' \
    --quiet
awk -F, 'NR > 1 && ($4 > 1e-9 || $4 < -1e-9) { bad = 1 } END { exit bad || NR < 10 || $5 < 0.085 || $5 > 0.09 }' wave/history.csv ||
    { tail -n 2 wave/history.csv; exit 1; }

# Provenance names the law, and a checkpoint is of that law.
run 0 run "$good/solid-still.yaml" -o still --set 'output={checkpoints: {every: 1 us}}' --quiet
grep -q '"name": "neo-hookean"' still/provenance.json
run 2 run "$good/solid-still.yaml" -o still --restart --until 2e-6 --set materials.gel.constitutive.preset=liver
grep -q "of another case: materials.gel.constitutive is 'neo-hookean shear-modulus=7.23e+03" err.txt

# Solvers that do not say that they know solids: one of today, and one from before they could say it.
"$BULLA" new module riemann roe >/dev/null
sed 's/\.size = sizeof(struct bulla_riemann)/.size = 16/' roe/roe.c >old.c
grep -q '\.size = 16' old.c
for source in roe/roe.c old.c; do
    "${CC:-cc}" -shared -fPIC -fvisibility=hidden -I"$BULLA_SOURCE/core/include" "$source" -o roe.so
    run 2 check "$good/solid-still.yaml" --set "modules=[$PWD/roe.so]" --set scheme.riemann=roe
    grep -q "scheme.riemann: 'roe' computes fluids only, but 'gel' is a solid" err.txt
    grep -q "'riemann: hlld'" err.txt
    run 0 check "$good/minimal.yaml" --set "modules=[$PWD/roe.so]" --set scheme.riemann=roe
done

# The exact solution of tubes is one of fluids that move along the tube.
norm='expect=[{norm: L1, field: density, reference: exact-riemann, at-most: 1}]'
run 2 run "$good/solid-still.yaml" -o tube --set output={} --set "$norm"
grep -q "'exact-riemann' is the solution of fluids, and 'gel' is a solid" err.txt
run 2 run "$good/minimal.yaml" -o tube --set "$norm" --set domain.velocity-components=2
grep -q "'exact-riemann' needs velocities of one component, not 2" err.txt
