# One version: the project's, the SDK's, the citation's and that of the newest heading of the changelog.
set -eu
cd "$BULLA_SOURCE"
version=$(sed -n 's/^project(bulla VERSION \([0-9.]*\) .*/\1/p' CMakeLists.txt)
[ -n "$version" ]
grep -qx "set(PACKAGE_VERSION $version)" core/include/bulla/bullaConfigVersion.cmake || { echo "bullaConfigVersion.cmake: not $version"; exit 1; }
grep -qx "version: $version" CITATION.cff || { echo "CITATION.cff: not $version"; exit 1; }
[ "$(sed -n 's/^## \([0-9.]*\).*/\1/p' CHANGELOG.md | head -n 1)" = "$version" ] || { echo "CHANGELOG.md: not $version"; exit 1; }
