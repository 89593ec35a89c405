# Layout: the sources are as clang-format lays them out (.clang-format). Other versions differ
# in details, so only the version of Debian 12 judges.
set -eu
clang-format --version 2>/dev/null | grep -q 'version 14\.' || { echo "skipped: no clang-format 14"; exit 77; }
cd "$BULLA_SOURCE"
find core modules tests -name '*.[ch]' ! -path 'tests/data/*' | sort | xargs clang-format --dry-run -Werror
