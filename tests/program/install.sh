# An installed bulla is whole and may be moved: modules, SDK, cases and the drawing program are found from where it lies.
. "$BULLA_SOURCE/tests/lib.sh"
set -eu
unset BULLA_MODULE_PATH
DESTDIR= cmake --install "$BULLA_BUILD" --prefix "$PWD/first" >log || fail "cmake --install" log
mkdir -p "else where"
mv first "else where/bulla"
place="$PWD/else where/bulla"
PATH=$place/bin:$PATH

for file in bin/bulla bin/bulla-view include/bulla/module.h include/bulla/skeleton/any/Makefile lib/cmake/bulla/bullaConfig.cmake \
    share/bulla/schemas/case.schema.json share/bulla/cases/tour/tube.yaml share/doc/bulla/docs/modules.md \
    share/man/man1/bulla.1 share/bash-completion/completions/bulla share/zsh/vendor-completions/_bulla \
    share/fish/vendor_completions.d/bulla.fish share/doc/bulla/LICENSE share/doc/bulla/cases/tour/tube.yaml; do
    [ -f "$place/$file" ] || fail "not installed: $file"
done
[ ! -e "$BULLA_BUILD/bin/bulla-watch" ] || [ -f "$place/bin/bulla-watch" ] || fail "not installed: bin/bulla-watch"
find "$BULLA_BUILD/lib/bulla/modules" -name '*.so' -printf '%f\n' | sort >built
find "$place/lib/bulla/modules" -name '*.so' -printf '%f\n' | sort >installed
[ -s built ] && cmp built installed || fail "not all modules are installed"
if grep -q '^BULLA_HDF5_ARCHIVE:BOOL=ON' "$BULLA_BUILD/CMakeCache.txt" &&
    grep -q '^BULLA_HDF5_ARCHIVE_LINKS:INTERNAL=1' "$BULLA_BUILD/CMakeCache.txt"; then
    ! ldd "$place/bin/bulla" | grep hdf5 || fail "a program opens HDF5's library beside the archive in it"
    ls /usr/share/doc/libhdf5*-dev/copyright >/dev/null 2>&1 && [ ! -f "$place/share/doc/bulla/copyright.hdf5" ] &&
        fail "HDF5's notice is not installed"
fi
! grep -rlF "$PWD/first" "$place/lib/cmake" "$place/share/pkgconfig" || fail "names the place it was installed in"

bulla schema | cmp - "$place/share/bulla/schemas/case.schema.json" || fail "the schema is another one"
case=$place/share/bulla/cases/tour/tube.yaml
for ranks in 1 2; do
    complete bulla run "$case" -o tube$ranks -n $ranks --quiet --set domain.cells='[100]' --set expect='[]' >said 2>&1
    [ "$code" = 0 ] || fail "run -n $ranks" said
done
cmp tube1/history.csv tube2/history.csv || fail "two ranks differ"
bulla plot tube1 density >said 2>&1 || fail "plot" said
[ -s "$(tail -n 1 said)" ] || fail "no picture" said
(cd / && bulla verify --list) >said 2>&1 || fail "verify --list" said

# The SDK for authors of modules: a project of their own, CMake, pkg-config.
if command -v make >/dev/null; then
    bulla new module eos my-water >said 2>&1 && make -C my-water check >>said 2>&1 || fail "bulla new module" said
    grep -q "^SDK ?= $place/include$" my-water/Makefile || fail "another SDK" my-water/Makefile
fi
cmake -S "$BULLA_SOURCE/tests/plugin" -B plugin -DCMAKE_PREFIX_PATH="$place" >said 2>&1 || fail "find_package" said
cmake --build plugin >said 2>&1 || fail "bulla_add_module" said
bulla module check plugin/eos-tait-murnaghan.so >said 2>&1 || fail "the plugin" said
export PKG_CONFIG_PATH="$place/share/pkgconfig"
eval "set -- $(pkg-config --cflags bulla)"
${CC:-cc} -O2 -fPIC -shared "$@" "$BULLA_SOURCE/tests/plugin/tait_murnaghan.c" -o eos-tait-murnaghan.so -lm || fail "pkg-config: $*"
bulla module check ./eos-tait-murnaghan.so >said 2>&1 || fail "the plugin by pkg-config" said
[ "$(pkg-config --modversion bulla)" = "$(sed -n 's/^set(PACKAGE_VERSION \(.*\))/\1/p' \
    "$place/lib/cmake/bulla/bullaConfigVersion.cmake")" ] || fail "two versions"
