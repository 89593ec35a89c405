# docs/modules.md, tried literally: its `sh` blocks are run, its `diff` blocks are applied, and each line of a `text` block
# stands in what the last command said (numbers between the words do not count). "sh fails" must fail.
set -eu
command -v make >/dev/null && command -v patch >/dev/null || { echo "skipped: no make or patch"; exit 77; }
place=$PWD
mkdir bin && ln -s "$BULLA" bin/bulla
PATH=$PWD/bin:$PATH
awk -v place="$place" '
    /^```(sh|diff|text)/ { kind = $2 == "fails" ? "fails" : substr($1, 4); file = sprintf("%s/%03d.%s", place, ++n, kind); next }
    /^```/ { if (file) close(file); file = ""; next }
    file { print > file }' "$BULLA_SOURCE/docs/modules.md"

fail() {
    echo "$1"
    cat "$place/out"
    exit 1
}
blocks=0
for block in "$place"/[0-9]*.*; do
    blocks=$((blocks + 1))
    case $block in
    *.sh) . "$block" >"$place/out" 2>&1 || fail "$block does not run" ;; # here, for its cd
    *.fails) if (. "$block") >"$place/out" 2>&1; then fail "$block does not fail"; fi ;;
    *.diff) patch -p0 <"$block" >"$place/out" 2>&1 || fail "$block does not apply" ;;
    *.text)
        while read -r line; do
            awk -v line="$line" '
                { said = $0; gsub(/ +/, " ", said) }
                BEGIN { n = split(line, word, / (FAIL|pass)$/); begin = word[1]; end = substr(line, length(begin) + 2) }
                index(said, begin) && (end == "" || index(said, end)) { found = 1 }
                END { exit !found }' "$place/out" || fail "nothing says '$line'"
        done <"$block"
        ;;
    esac
done
[ $blocks -ge 10 ] || fail "only $blocks blocks"
