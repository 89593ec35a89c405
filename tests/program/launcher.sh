# The launcher: builds once, notices changes, explains what is missing. Tools are replaced by
# stand-ins that write down how they were called.
set -eu
rm -rf tree tools && mkdir -p tree/core tree/modules tools
cp "$BULLA_SOURCE/bulla" tree/bulla
touch tree/CMakeLists.txt tree/CMakePresets.json

tool() { # NAME BODY
    printf '#!/bin/sh\nprintf "%s %%s\\n" "$*" >>"%s/calls"\n%s\n' "$1" "$PWD" "$2" >"tools/$1"
    chmod +x "tools/$1"
}
tool dpkg-query 'echo "install ok installed"'
tool cmake 'case "$*" in
*--build*) mkdir -p "$2/bin"; printf "#!/bin/sh\necho program \$PWD \"\$@\"\n" >"$2/bin/bulla"; chmod +x "$2/bin/bulla" ;;
*) touch build/build.ninja; echo "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" >build/CMakeCache.txt
    case "$*" in *WERROR=ON*) echo "BULLA_WERROR:BOOL=ON" ;; *) echo "BULLA_WERROR:BOOL=OFF" ;; esac >>build/CMakeCache.txt ;;
esac'
tool ctest 'echo summary'
tool apt-get ':'
tool sudo '"$@"'
here=$PWD
PATH=$here/tools:$PATH
unset BULLA_NO_INSTALL BULLA_BUILD_DIR BULLA_WERROR CI
calls() { grep -c "$1" calls || true; }
fail() { echo "$*"; cat calls; exit 1; }

: >calls
[ "$(tree/bulla run "a b" 2>log)" = "program $here run a b" ] || fail "arguments or directory lost"
grep -q 'building into' log || fail "does not say that it builds"
[ "$(calls 'cmake --build')" = 1 ] || fail "no build on the first call"
[ "$(calls apt-get)" = 0 ] || fail "installs although nothing is missing"

: >calls
mkdir -p elsewhere
[ "$(cd elsewhere && ../tree/bulla x 2>../log)" = "program $here/elsewhere x" ] || fail "not from another directory"
[ ! -s log ] && [ ! -s calls ] || fail "the second call does more than start the program"
ln -sf "$here/tree/bulla" tools/linked
[ "$(linked x)" = "program $here x" ] || fail "not through a link"

find tree -exec touch -d 2000-01-01 {} +
touch tree/core/new.c
: >calls
tree/bulla x >log 2>&1
[ "$(calls 'cmake --build')" = 1 ] || fail "a new source is not built"
[ "$(calls 'cmake --preset')" = 0 ] || fail "configures again"
grep -q 'BULLA_WERROR:BOOL=OFF' tree/build/CMakeCache.txt || fail "a run does not forgive warnings"

: >calls
[ "$(tree/bulla test -R abc 2>log | tail -n 1)" = summary ] || fail "the test summary is not last"
grep -q 'ctest .*-R abc' calls || fail "ctest does not get the arguments"
tool ctest 'exit 8'
code=0
tree/bulla test >log 2>&1 || code=$?
[ "$code" = 1 ] || fail "failed tests give exit code $code"

# Warnings are errors in a folder that tests make and in CI, not for who wants to run; only a change configures anew.
[ "$(calls 'cmake --preset')" = 0 ] || fail "tests after a run build everything a second time"
rm -rf tree/build
tree/bulla test >log 2>&1 || true
grep -q -- '--preset release -DBULLA_WERROR=ON -B' calls || fail "tests forgive warnings"
: >calls
tree/bulla test >log 2>&1 || true
touch tree/core/again.c
tree/bulla x >log 2>&1
[ "$(calls 'cmake --build')" = 2 ] && [ "$(calls 'cmake --preset')" = 0 ] || fail "configures without need"
touch tree/core/again.c
BULLA_WERROR=OFF tree/bulla x >log 2>&1
grep -q -- '-DBULLA_WERROR=OFF' calls || fail "BULLA_WERROR=OFF is not heard"
: >calls
touch tree/core/again.c
CI=true tree/bulla x >log 2>&1
grep -q -- '-DBULLA_WERROR=ON' calls || fail "CI forgives warnings"

# Missing packages: named when installing is forbidden, installed when it is not.
tool dpkg-query 'case "$*" in *lua5.4*) exit 1 ;; esac; echo "install ok installed"'
rm -rf tree/build
code=0
BULLA_NO_INSTALL=1 tree/bulla x >log 2>&1 || code=$?
[ "$code" = 3 ] || fail "exit code $code without packages"
grep -q 'missing packages.* liblua5.4-dev' log || fail "does not name the package: $(cat log)"
: >calls
tree/bulla x >log 2>&1
grep -q '^apt-get update' calls || fail "no apt-get update"
grep -q '^apt-get install .* liblua5.4-dev$' calls || fail "no apt-get install of the one package"
grep -q 'installing Debian packages.*liblua5.4-dev' log || fail "does not say what it installs"

# A build that fails shows its last lines.
tool dpkg-query 'echo "install ok installed"'
tool cmake 'echo broken source line; exit 1'
find tree -exec touch -d 2000-01-01 {} +
touch tree/core/newer.c
code=0
tree/bulla x >log 2>&1 || code=$?
[ "$code" = 3 ] && grep -q 'broken source line' log || fail "exit code $code, says $(cat log)"
