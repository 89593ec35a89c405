# bulla new module: for each kind a project outside the tree that builds, passes its test, the contract of its kind and
# its case, with the program as built and as installed; names and folders that do not do are refused.
set -eu
command -v make >/dev/null || { echo "skipped: no make"; exit 77; }
fail() {
    echo "$1"
    cat out
    exit 1
}
refused() { # CODE PATTERN ARGS...
    wanted=$1 pattern=$2
    shift 2
    code=0
    "$BULLA" new "$@" >out 2>&1 || code=$?
    [ $code = "$wanted" ] || fail "new $*: exit code $code, not $wanted"
    grep -qE -- "$pattern" out || fail "new $*: does not say '$pattern'"
}

for kind in boundary conductivity constitutive damage eos field inelastic limiter reconstruction riemann viscosity; do
    "$BULLA" new module $kind my-$kind >out 2>&1 || fail "no $kind was made"
    for file in Makefile README.md case.yaml my_$kind.c my_${kind}_test.c; do
        [ -s my-$kind/$file ] || fail "my-$kind/$file is not there"
    done
    if grep -rnE 'the.name|@[A-Z]+@' my-$kind; then fail "a place was not filled in"; fi
    (cd my-$kind && make CFLAGS='-O3 -Wall -Wextra -Wshadow -Wconversion -Werror' && make check) >out 2>&1 ||
        fail "$kind does not build or hold"
    grep -q "my-$kind: pass" out && grep -q '^pass: all' out || fail "$kind was not tested"
    grep -q "\"name\": *\"my-$kind\"" my-$kind/out/provenance.json || fail "the case did not use my-$kind"
    [ "$(nm -D --defined-only my-$kind/$kind-my-$kind.so | awk '{print $3}')" = bulla_module ] || fail "it exports more"
done

# A mistake is found: the derivative of another law.
sed -i 's/de_drho\[i\] = 0.0/de_drho[i] = 5.0/' my-eos/my_eos.c
code=0
make -C my-eos check >out 2>&1 || code=$?
[ $code != 0 ] && grep -q 'd(rho e)/drho is the slope of rho e .* FAIL' out || fail "a wrong derivative passed"

sed -i 's/e_1\[i\] = par.k \* (1.0/e_1[i] = par.k * (1.1/' my-constitutive/my_constitutive.c
code=0
make -C my-constitutive check >out 2>&1 || code=$?
[ $code != 0 ] && grep -q 'pull: .* instead of 385000' out || fail "a wrong stress passed its test"
"$BULLA" module check my-constitutive/constitutive-my-constitutive.so >out 2>&1 && fail "a wrong stress passed"
grep -q 'e_1 is the slope of e along I1 .* FAIL' out || fail "a wrong stress was not found"

# One that pulls the wrong way is refused before any run.
sed -i 's/e_1\[i\] = par.k/e_1[i] = -par.k/' my-constitutive/my_constitutive.c
make -C my-constitutive >out 2>&1 || fail "it does not build"
code=0
(cd my-constitutive && "$BULLA" run case.yaml --overwrite --quiet) >out 2>&1 || code=$?
[ $code = 2 ] && grep -q "'my-constitutive' gives no finite energy that rises" out || fail "it was let in"

# A folder that is there stays as it is.
refused 2 'my-eos is there already' module eos my-eos
grep -q 'de_drho\[i\] = 5.0' my-eos/my_eos.c || fail "it was overwritten"
for name in My-Law 3law a--b a- -a '' a/b a.b 'a b' ../up aaaaaaaaaabbbbbbbbbbccccccccccddddddddddeeeeeeeeeefff; do
    refused 2 'is no name for a module|has no option' module eos "$name"
done
refused 2 "kind eos has a module 'nasg' already" module eos nasg
refused 2 "did you mean 'limiter'\?.*eos, field, inelastic, limiter, reconstruction, riemann" module limitr my-law
refused 2 'bulla new module KIND NAME' thing eos my-law
refused 2 'KIND NAME' module eos
"$BULLA" new module eos under_score >out 2>&1 || fail "an identifier is a name too"
grep -q '"under-score"' under_score/under_score.c && grep -q 'under_score_state' under_score/under_score.c ||
    fail "underscores are not hyphens in cases"

# Where nothing can be written: exit code 3.
mkdir shut && chmod 500 shut
if [ "$(id -u)" != 0 ]; then (cd shut && refused 3 'cannot be made' module eos my-law); fi

# Installed: headers and skeletons lie beside the program.
cmake --install "$BULLA_BUILD" --prefix "$PWD/there" >out 2>&1 || fail "cannot be installed"
env -u BULLA_MODULE_PATH there/bin/bulla new module limiter sharp >out 2>&1 || fail "not from the installed program"
grep -q "^SDK ?= $PWD/there/include$" sharp/Makefile || fail "the SDK is not the installed one"
env -u BULLA_MODULE_PATH make -C sharp check >out 2>&1 || fail "does not hold with the installed program"
