#!/bin/sh
# words.sh PROGRAM FOLDER - writes shell completions and the manual page, from what the program's own tables say:
# FOLDER/bulla.bash, bulla.fish, _bulla (zsh), bulla.1. Commands come from `bulla help`, options from `bulla COMMAND -h`,
# so that an option that is added to a table is in all four.
set -eu
program=$1 folder=$2
export LC_ALL=C
mkdir -p "$folder"
tab=$(printf '\t')

# command TAB words TAB doc
"$program" help | awk '
    function flush() { if (name != "") print name "\t" words "\t" doc; name = "" }
    NR > 1 && /^  [a-z]/ {
        flush()
        text = substr($0, 3)
        head = substr(text, 1, 28); doc = ""
        if (substr(text, 29, 1) == " " && length(text) > 29 && head !~ /[^ ].*   +[^ ]/) { doc = substr(text, 30) } else head = text
        sub(/ +$/, "", head)
        name = words = head
        sub(/ .*/, "", name)
        sub(/^[^ ]* ?/, "", words)
        if (doc != "") flush()
        next
    }
    name != "" && /^   / { doc = $0; sub(/^ +/, "", doc); flush() }' >"$folder/commands"

# command TAB letter TAB option TAB value TAB doc; none of a command whose program was not built
: >"$folder/options"
cut -f1 "$folder/commands" | while read -r command; do
    "$program" "$command" -h 2>/dev/null | awk -v command="$command" '
        function flush() { if (name != "") print command "\t" letter "\t" name "\t" value "\t" doc; name = "" }
        /^  -/ {
            flush()
            text = substr($0, 3)
            head = substr(text, 1, 28); doc = ""
            if (substr(text, 29, 1) == " " && head ~ /^[^ ]/) doc = substr(text, 30); else head = text
            sub(/ +$/, "", head)
            letter = name = value = ""
            n = split(head, part, " ")
            i = 1
            if (part[1] ~ /,$/) { letter = part[1]; sub(/,/, "", letter); i = 2 }
            name = part[i]
            for (i++; i <= n; i++) value = value (value == "" ? "" : " ") part[i]
            if (doc != "") flush()
            next
        }
        name != "" && /^   / { doc = $0; sub(/^ +/, "", doc); flush() }' >>"$folder/options"
done
[ -s "$folder/commands" ] && [ -s "$folder/options" ]

{
    echo '# bash completion of bulla'
    echo '_bulla() {'
    echo '    local word=${COMP_WORDS[COMP_CWORD]}'
    echo '    COMPREPLY=()'
    echo "    if [ \"\$COMP_CWORD\" = 1 ]; then COMPREPLY=(\$(compgen -W '$(cut -f1 "$folder/commands" | tr '\n' ' ')' -- \"\$word\")); return; fi"
    echo '    case $word in -*) ;; *) return ;; esac'
    echo '    case ${COMP_WORDS[1]} in'
    awk -F '\t' '{ if (!($1 in all)) order[++n] = $1; all[$1] = all[$1] " " ($2 == "" ? "" : $2 " ") $3 }
        END { for (i = 1; i <= n; i++) printf "    %s) COMPREPLY=($(compgen -W \047%s --help\047 -- \"$word\")) ;;\n", order[i], substr(all[order[i]], 2) }' "$folder/options"
    printf '    esac\n}\ncomplete -o default -F _bulla bulla\n'
} >"$folder/bulla.bash"

sed "s/'/\\\\'/g" "$folder/commands" | awk -F '\t' '{
    printf "complete -c bulla -n __fish_use_subcommand -f -a %s -d \047%s\047\n", $1, $3 }' >"$folder/bulla.fish"
sed "s/'/\\\\'/g" "$folder/options" | awk -F '\t' '{
    printf "complete -c bulla -n \047__fish_seen_subcommand_from %s\047%s -l %s%s -d \047%s\047\n", $1,
        $2 == "" ? "" : " -s " substr($2, 2), substr($3, 3), $4 == "" || $4 ~ /^\[/ ? "" : " -r", $5 }' >>"$folder/bulla.fish"

{
    printf '#compdef bulla\nlocal -a commands\ncommands=(\n'
    sed "s/'/'\\\\''/g; s/:/\\\\:/g" "$folder/commands" | awk -F '\t' '{ printf "    \047%s:%s\047\n", $1, $3 }'
    printf ')\nif (( CURRENT == 2 )); then _describe command commands; return; fi\nlocal command=$words[2]\nshift words\n(( CURRENT-- ))\ncase $command in\n'
    sed "s/'/'\\\\''/g; s/[]:[]/\\\\&/g" "$folder/options" | awk -F '\t' '
        function one(spelled, value, doc) { printf " \047*%s[%s]%s\047", spelled, doc, value == "" ? "" : (value ~ /^\\\[/ ? "::" : ":") value ":_files" }
        $1 != last { if (last != "") print " \047*:file:_files\047 ;;"; printf "%s) _arguments", $1; last = $1 }
        { if ($2 != "") one($2, $4, $5); one($3, $4, $5) }
        END { print " \047*:file:_files\047 ;;" }'
    printf '*) _files ;;\nesac\n'
} >"$folder/_bulla"

{
    printf '.TH BULLA 1 "" "%s" "User Commands"\n' "$("$program" version | sed 's/ (.*//')"
    printf '.SH NAME\nbulla \\- simulates bubbles, shocks and soft materials from case files\n.SH SYNOPSIS\n.B bulla\nCOMMAND ...\n.SH COMMANDS\n'
    while IFS=$tab read -r command rest; do
        line=$(grep "^$command$tab" "$folder/commands")
        words=$(printf '%s\n' "$line" | cut -f2)
        doc=$(printf '%s\n' "$line" | cut -f3)
        printf '.SS "bulla %s %s"\n%s\n' "$command" "$words" "$doc"
        awk -F '\t' -v command="$command" '$1 == command {
            printf ".TP\n\\fB%s%s\\fR %s\n%s\n", $2 == "" ? "" : $2 "\\fR, \\fB", $3, $4, $5 }' "$folder/options"
    done <"$folder/commands" | sed "s/-/\\\\-/g; s/^'/\\\\\&'/"
    printf '.SH EXIT STATUS\n'
    "$program" help | sed -n 's/^Exit codes: //p' | sed 's/; /\n.br\n/g'
    printf '.SH FILES\nCases, schema and pages: share/bulla and share/doc/bulla beside the program\\(aqs folder.\n'
} >"$folder/bulla.1"
rm "$folder/commands" "$folder/options"
