# seeds.awk - reads seeds.txt (its format is said there) and looks every seed up in the tree.
#
#     awk -f seeds.awk seeds.txt FILES                      one line per seed: name, file, line number of the file, tests,
#                                                           reason why it survives, what it is; tabs between
#     awk -v seed=NAME -f seeds.awk seeds.txt FILES         the file of that seed with the mistake in it
#
# FILES: the names of all sources, one per line. Ends with 1 if the table is wrong: a text that is not found in exactly
# one place of the files that `in` matches, a field missing, a name twice.

function complain(what) {
    print "tests/mutants/seeds.txt:" at[n] ": " name[n] ": " what >"/dev/stderr"
    bad = 1
}

function finish() {
    if (!n) return
    if (!(n in from)) complain("no line '- ' with the text that is right")
    if (!(n in to)) complain("no line '+ ' with the mistake")
    if (!(n in glob)) complain("no line 'in' with the files")
    if (!(n in tests)) complain("no line 'test' with the tests that should see it")
    if ((n in from) && from[n] == to[n]) complain("the mistake is what is there")
}

# A shell pattern with * (which stops at a slash) as a regular expression.
function pattern(text) {
    gsub(/[.+]/, "\\\\&", text)
    gsub(/\*/, "[^/]*", text)
    return "^" text "$"
}

FNR == 1 { part++ }
part == 1 && /^(#|$)/ { next }
part == 1 && /^seed / {
    finish()
    n++
    at[n] = FNR
    name[n] = $2
    sub(/:$/, "", name[n])
    said[n] = substr($0, index($0, ":") + 2)
    if (index($0, ":") == 0) complain("no ': ' and what the mistake is")
    if (known[name[n]]++) complain("a name that is taken")
    next
}
part == 1 && /^in / { glob[n] = $2; next }
part == 1 && /^- / { from[n] = substr($0, 3); next }
part == 1 && /^\+ / { to[n] = substr($0, 3); next }
part == 1 && /^\+$/ { to[n] = ""; next }
part == 1 && /^test / { tests[n] = $2; next }
part == 1 && /^survives / { reason[n] = substr($0, 10); next }
part == 1 { complain("a line that is none of seed, in, -, +, test, survives: " $0); next }
part == 2 { files[++n_file] = $0 }

# One pass over every file that a seed may be in.
END {
    finish()
    for (i = 1; i <= n; i++) expression[i] = pattern(glob[i])
    for (f = 1; f <= n_file; f++) {
        wanted = 0
        for (i = 1; i <= n; i++)
            if ((seed == "" || name[i] == seed) && files[f] ~ expression[i]) look[++wanted] = i
        if (!wanted) continue
        number = 0
        while ((getline line <files[f]) > 0) {
            number++
            for (k = 1; k <= wanted; k++) {
                i = look[k]
                rest = line
                while ((place = index(rest, from[i])) > 0) {
                    found[i]++
                    where[i] = files[f]
                    row[i] = number
                    rest = substr(rest, place + length(from[i]))
                }
            }
        }
        close(files[f])
    }
    last = n
    for (n = 1; n <= last; n++) {
        if (seed != "" && name[n] != seed) continue
        if (found[n] != 1) complain("does not apply: its text is " (found[n] ? "in " found[n] " places of " : "nowhere in ") glob[n])
        else if (seed == "") print name[n] "\t" where[n] "\t" row[n] "\t" tests[n] "\t" reason[n] "\t" said[n]
        else mutate(n)
    }
    exit bad
}

function mutate(i,    number, line, place) {
    while ((getline line <where[i]) > 0) {
        place = ++number == row[i] ? index(line, from[i]) : 0
        if (place) line = substr(line, 1, place - 1) to[i] substr(line, place + length(from[i]))
        print line
    }
}
