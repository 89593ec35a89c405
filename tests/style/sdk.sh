# The SDK: each header stands alone, in strict C11 and in C++, and needs nothing but the two
# freestanding headers it may include.
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$BULLA_SOURCE/core/include"
status=0
for header in bulla/*.h; do
    printf '#include "%s"\n' "$header" >"$scratch/alone.c"
    cp "$scratch/alone.c" "$scratch/alone.cpp"
    "${CC:-cc}" -std=c11 -pedantic -Wall -Wextra -Werror -ffreestanding -fsyntax-only -I. "$scratch/alone.c" || status=1
    if command -v "${CXX:-c++}" >/dev/null; then
        "${CXX:-c++}" -std=c++11 -pedantic -Wall -Wextra -Werror -fsyntax-only -I. "$scratch/alone.cpp" || status=1
    fi
    foreign=$(grep -hE '^#include' "$header" | grep -vE '<std(def|int)\.h>|"bulla/' || true)
    [ -z "$foreign" ] || { echo "$header: $foreign"; status=1; }
done
exit $status
