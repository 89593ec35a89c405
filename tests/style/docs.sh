# README and docs name only what is there: relative links resolve, every file in backticks exists (by
# path, or by name somewhere in the tree), every `function()` is defined, every `CONSTANT_NAME` occurs. Lines of prose are
# no wider than 120 characters; tables, code and pages that a command writes are as wide as they need.
set -eu
cd "$BULLA_SOURCE"
bad=0
complain() { echo "$1: $2"; bad=1; }

tree=$(find . -path ./build -prune -o -path ./.git -prune -o -type f -print)
known() { printf '%s\n' "$tree" | grep -q "/$1\$"; }

for page in README.md CHANGELOG.md docs/*.md docs/decisions/*.md; do
    case $page in docs/keys.md | docs/beside.md) ;; *)
        wide=$(sed '/^```/,/^```/d; /^|/d; /^    /d; /^!\[/d; /^<!--/d' "$page" | LC_ALL=C.UTF-8 grep -E '^.{121,}' | cut -c1-60 || true)
        [ -z "$wide" ] || complain "$page" "wider than 120 characters: $wide"
        ;;
    esac
    marks=$(grep '^<!-- .* -->$' "$page" | grep -v '^<!-- end ' | sed 's/^<!-- \(verify \)*//') # --save writes between
    ends=$(sed -n 's/^<!-- end \(.* -->\)$/\1/p' "$page")
    [ "$marks" = "$ends" ] || complain "$page" "marks of tables without their ends, or ends without marks"
    folder=$(dirname "$page")
    for link in $(grep -o ']([^)# ]*' "$page" | cut -c3- | sort -u); do
        case $link in http*) continue ;; esac
        [ -e "$folder/$link" ] || complain "$page" "the link '$link' leads nowhere"
    done
    for file in $(grep -o '`[A-Za-z0-9_./-]*\.\(c\|h\|sh\)`' "$page" | tr -d '`' | sort -u); do
        known "${file#./}" || complain "$page" "there is no file '$file'"
    done
    for name in $(grep -o '`[a-z][a-z0-9_]*()`' "$page" | tr -d '`()' | sort -u); do
        grep -rqE "^[a-z].*\b$name\(" core modules tests || complain "$page" "there is no function '$name'"
    done
    for name in $(grep -o '`[A-Z]\{3,\}_[A-Z_]*`' "$page" | tr -d '`' | sort -u); do
        grep -rqw "$name" core modules tests CMakeLists.txt bulla || complain "$page" "there is no '$name'"
    done
done
exit $bad
