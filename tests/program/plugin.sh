# A plugin from outside the tree: built as its author would, found through BULLA_MODULE_PATH and
# through `modules:` in a case, its keys read, checked and documented like those of a built-in law.
set -eu
cmake -G Ninja -S "$BULLA_SOURCE/tests/plugin" -B plugin -Dbulla_DIR="$BULLA_SOURCE/core/include/bulla" >log 2>&1 &&
    cmake --build plugin >>log 2>&1 || { cat log; exit 1; }
object=plugin/eos-tait-murnaghan.so
[ "$(nm -D --defined-only "$object" | awk '{print $3}')" = bulla_module ] || { echo "it exports more than its name"; exit 1; }

fail() {
    echo "$1"
    cat out
    exit 1
}

case_file() { # NAME LINE-BEFORE EOS
    cat >"$1.yaml" <<END
bulla: 1
title: A pressure wave in Tait-Murnaghan water
about: Written by a test.
$2
domain:
  geometry: cartesian
  lower: [0]
  upper: [1 m]
  cells: [64]
  boundaries: {x-: reflecting, x+: reflecting}
materials:
  water: {eos: $3}
initial:
  - {everywhere: true, material: water, density: 998.2, pressure: 1e5}
  - {box: {lower: [0], upper: [0.5 m]}, material: water, density: 1002, pressure: 10 MPa}
scheme: {riemann: hllc, limiter: mc, cfl: 0.4}
run: {until: 0.1 ms}
output:
  directory: $1.out
  history: {every: 1 step, columns: {pmax: {max: pressure}, rho: {mean: density}, mass: {mass: water}}}
END
}

# Listed and documented: only with the plugin on the path.
"$BULLA" modules tait-murnaghan >out 2>&1 && fail "found without being on the path"
BULLA_MODULE_PATH=$PWD/plugin:$BULLA_MODULE_PATH "$BULLA" modules tait-murnaghan >out
grep -q 'grueneisen  *1  *0.11  *0.01 to 5  *Grueneisen coefficient' out || fail "its parameters are not documented"

# Used by name, with its own keys and units.
case_file path "" "{type: tait-murnaghan, sound-speed: 1.482 km/s, grueneisen: 0.2}"
"$BULLA" check path.yaml >out 2>&1 && fail "a law that is not loaded was accepted"
grep -q 'tait-murnaghan' out || fail "the message does not name the law"
BULLA_MODULE_PATH=$PWD/plugin:$BULLA_MODULE_PATH "$BULLA" run path.yaml >out 2>&1 || fail "the run failed"

# Named by the case, relative to the case file, from another folder.
case_file named "modules: [./$object]" "{type: tait-murnaghan, sound-speed: 1482, grueneisen: 0.2}"
mkdir elsewhere
(cd elsewhere && "$BULLA" run ../named.yaml -o ../named.out) >out 2>&1 || fail "the run failed"
cmp path.out/history.csv named.out/history.csv || fail "km/s and m/s differ"
grep -q tait-murnaghan named.out/provenance.json || fail "the module is not in the provenance"

# Its ranges, units and names are checked like any other.
for wrong in "grueneisen: 7" "sound-speed: 3 kg" "gruneisen: 0.2"; do
    case_file wrong "modules: [./$object]" "{type: tait-murnaghan, $wrong}"
    code=0
    "$BULLA" check wrong.yaml >out 2>&1 || code=$?
    [ $code = 2 ] || fail "'$wrong' gives exit code $code"
    grep -q "wrong.yaml:12:[0-9]*: error: .*${wrong%%:*}" out || fail "'$wrong' is not pointed at"
done

# A file that is no module is refused with its name, and so is a second one of the same name.
case_file broken "modules: [./log]" "{type: tait-murnaghan}"
"$BULLA" check broken.yaml >out 2>&1 && fail "a text file was accepted as a module"
grep -q 'log is not a shared object' out || fail "the refusal does not say why"
