# Words that must not appear: flags that change arithmetic, min/max calls that stop loops from
# becoming vectors, notes to self, machine paths.
set -eu
cd "$BULLA_SOURCE"
status=0
forbid() { # PATTERN REASON FILES...
    pattern=$1 reason=$2
    shift 2
    if grep -nE -- "$pattern" "$@" /dev/null; then
        echo "^ $reason"
        status=1
    fi
}

fast='-ffast-math|-Ofast|-ffinite-math-only|-funsafe-math|-fassociative-math|-freciprocal-math|-ffp-contract=(fast|on)'
forbid "$fast" "the optimiser may not change values" CMakeLists.txt CMakePresets.json bulla \
    "$BULLA_BUILD/compile_commands.json"
forbid 'pragma.*(fp_contract|fast|optimize)|__attribute__.*optimize' "the optimiser may not change values" \
    $(find core modules -name '*.[ch]')

forbid '^BULLA_KERNEL (void|double)' "kernels are static: clang 14 names clones so that other files do not find them" \
    $(find core modules -name '*.[ch]')

notes='TO''DO|FIX''ME|XX''X|HA''CK'
forbid "(^|[^A-Za-z_])($notes)([^A-Za-z_]|$)" "finish it or open an issue" \
    $(find core modules tests cases docs schemas -type f \( -name '*.[ch]' -o -name '*.sh' -o -name '*.yaml' \
        -o -name '*.md' -o -name '*.lua' -o -name CMakeLists.txt \) 2>/dev/null)

# Comments may speak of fmin; code may not. The preprocessor strips comments and keeps the lines.
for file in $(find modules core/phys core/paint core/scheme core/levels core/derive -name '*.c'); do
    if gcc -fpreprocessed -dD -E -w "$file" 2>/dev/null | grep -E '(^|[^A-Za-z_0-9])f(min|max)f? *\('; then
        echo "^ $file: write a < b ? a : b; fmin and fmax keep loops scalar"
        status=1
    fi
done
exit $status
