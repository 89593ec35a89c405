# The top level of the tree holds what docs speak of and nothing else: no list that a script left behind.
set -eu
cd "$BULLA_SOURCE"
git rev-parse --git-dir >/dev/null 2>&1 || { echo "skipped: not a checkout of git"; exit 77; }
found=$(git ls-files | cut -d/ -f1 | sort -u | grep -vxE '\.ci|\.clang-(format|tidy)|\.dockerignore|\.editorconfig|\.gitignore|bulla|cases|core|docs|modules|packaging|schemas|tests|CMakeLists\.txt|CMakePresets\.json|(CHANGELOG|CONTRIBUTING|README|SECURITY)\.md|CITATION\.cff|LICENSE') || true
[ -z "$found" ] || { echo "at the top level, and not in this list:"; echo "$found"; exit 1; }
