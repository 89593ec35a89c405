# Bounds of cases hold the true value, so that no improvement ever fails a test. Every `equals` of a quick variant is the
# number that the case itself has for the same value, or is marked, at the end of its line: `# true X, from where`, `# finest
# X` (of the finest mesh, where no true value is known) or `# own: why` (the program's own number at this mesh). X must lie
# within the bound. A case with `equals` says behind `expect: #` where its numbers are from. Lists what it has seen.
set -eu
cd "$BULLA_SOURCE"
awk '
    function number(key,    rest) { # of this line
        if (!match($0, "[ {]" key ": *[-+0-9.eE]+")) return "none"
        rest = substr($0, RSTART, RLENGTH)
        sub(/.*: */, "", rest)
        return rest + 0
    }
    function size(x) { return x < 0 ? -x : x }
    function complain(text) { print FILENAME ":" FNR ": " text; bad = 1 }
    function inside(truth,    equals, slack) {
        equals = number("equals")
        if (equals != "none") {
            slack = (number("tolerance") == "none" ? 0 : number("tolerance")) + (number("relative") == "none" ? 0 : number("relative") * size(equals))
            if (size(truth - equals) > slack) return 0
        }
        if (number("at-most") != "none" && truth > number("at-most")) return 0
        return number("at-least") == "none" || truth >= number("at-least")
    }
    FNR == 1 { split("", known); source = section = "" }
    /^[a-z-]+:/ { section = $1 }
    /^expect:/ { source = $0 ~ /# (true values|finest mesh)/ }
    !/^ *- *\{value: / { next }
    { total++ }
    match($0, /# (true|finest) [-+0-9.eE]+/) {
        truth = substr($0, RSTART, RLENGTH)
        sub(/.* /, "", truth)
        named++
        printf "%s:%d: %s %s\n", FILENAME, FNR, truth, inside(truth + 0) ? "lies inside" : "LIES OUTSIDE"
        if (!inside(truth + 0)) complain("the bound does not hold the true value")
    }
    / equals: / {
        text = $0
        sub(/.*\{value: "?/, "", text)
        sub(/"?, (label|equals).*/, "", text)
        mark = match($0, /\} *# *(true|finest|own)/)
        own += $0 ~ /\} *# *own/
        two_sided++
        if (section == "expect:") {
            known[text] = number("equals")
            if (!source) complain("say behind `expect: #` where the numbers are from: true values, or finest mesh")
        } else if (section == "quick:" && !mark) {
            if (!(text in known)) complain("mark the number: # true X, # finest X or # own: why")
            else if (known[text] != number("equals")) complain("the case has " known[text] ": the truth does not depend on the mesh")
        }
    }
    END {
        printf "%d bounds on values, %d two-sided, %d name their truth themselves, %d are the numbers of the program\n", total, two_sided, named, own
        if (total < 500) { print "where are the others?"; bad = 1 }
        exit bad
    }' cases/*/*.yaml
