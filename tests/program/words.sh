# Completions and manual page have every command and every option that the help has, and the shells read them.
. "$BULLA_SOURCE/tests/lib.sh"
set -eu
sh "$BULLA_SOURCE/packaging/words.sh" "$BULLA" words >said 2>&1 || fail "words.sh" said
[ ! -s said ] || fail "words.sh complains" said
sed 's/\\-/-/g' words/bulla.1 >page

section() { # COMMAND: its part of the page
    awk -v head=".SS \"bulla $1 " 'index($0, ".SS") == 1 { inside = index($0, head) == 1 } inside' page
}
has() { # WHERE WHAT FILE
    grep -qF -e "$2" "$3" || fail "$1: no $2" "$3"
}
total=0
for command in $("$BULLA" help | sed -n 's/^  \([a-z][a-z]*\) .*/\1/p'); do
    section "$command" >of_page
    [ -s of_page ] || fail "no part about $command" page
    grep "^    $command) " words/bulla.bash >of_bash || true
    grep "from $command'" words/bulla.fish >of_fish || true
    grep "^$command) " words/_bulla >of_zsh || true
    grep -q "[ ']$command[ ']" words/bulla.bash || fail "bash does not know $command"
    grep -q -- "-a $command " words/bulla.fish || fail "fish does not know $command"
    grep -q "^    '$command:" words/_bulla || fail "zsh does not know $command"
    for option in $("$BULLA" "$command" -h | grep -o '^  \(-[a-z], \)\{0,1\}--[a-z-]*' | grep -o -e '--[a-z-]*'); do
        total=$((total + 1))
        has "page, $command" "\\fB$option\\fR" of_page
        has "bash, $command" "$option" of_bash
        has "fish, $command" "-l ${option#--} " of_fish
        has "zsh, $command" "*$option[" of_zsh
    done
done
echo "$total options"
[ "$total" -gt 50 ] || fail "where are the options?"

if command -v bash >/dev/null; then
    # shellcheck disable=SC2016
    got=$(bash -c '. words/bulla.bash; COMP_WORDS=(bulla run --re); COMP_CWORD=2; _bulla; echo "${COMPREPLY[*]}"')
    [ "$got" = --restart ] || fail "bash completes run --re as '$got'"
    got=$(bash -c '. words/bulla.bash; COMP_WORDS=(bulla ver); COMP_CWORD=1; _bulla; echo "${COMPREPLY[*]}"')
    [ "$got" = "verify version" ] || fail "bash completes ver as '$got'"
fi
if command -v zsh >/dev/null; then zsh -n words/_bulla || fail "zsh does not read it"; fi
if command -v fish >/dev/null; then fish -n words/bulla.fish || fail "fish does not read it"; fi
if command -v man >/dev/null; then
    man -l --warnings words/bulla.1 >shown 2>said || fail "man" said
    [ ! -s said ] || fail "man complains" said
fi
