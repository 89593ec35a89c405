# Layers: a file of core includes only its own layer and those below it (of drawing and watching the solver knows one header each); modules
# see the SDK, headers beside them and those that families share; headers include each other without circles.
set -eu
cd "$BULLA_SOURCE"
find core modules -name '*.[ch]' ! -path 'core/include/*' | sort | xargs awk '
    BEGIN {
        n = split("base plug case mesh phys paint scheme levels derive solve io judge cli run batch suite view watch app", order, " ")
        for (i = 1; i <= n; i++) height[order[i]] = i
    }
    FNR == 1 { split(FILENAME, path, "/"); module = path[1] == "modules"; here = path[2] }
    FNR == 1 && !module && !(here in height) { print FILENAME ":1: not in a known layer: " here; bad = 1 }
    /^[ \t]*#[ \t]*include[ \t]*"/ {
        split($0, quoted, "\"")
        split(quoted[2], part, "/")
        if (part[1] == "bulla") next
        if (module && (part[1] == quoted[2] || part[1] == "shared") && quoted[2] ~ /\.h$/) next
        if (module)
            problem = "a module may include \"bulla/...\", headers beside it or in shared/ and the C library only"
        else if (!(part[1] in height))
            problem = "include as \"layer/file.h\""
        else if ((part[1] == "view" || part[1] == "watch") && here == "app" && part[2] != part[1] ".h")
            problem = part[1] " is another program: only " part[1] "/" part[1] ".h may be known here"
        else if (height[part[1]] > height[here])
            problem = "layer " here " may not include layer " part[1]
        else
            next
        print FILENAME ":" FNR ": " quoted[2] ": " problem
        bad = 1
    }
    END { exit bad }'

# Circles: tsort complains on stderr and fails when the header graph has a loop.
find core -name '*.h' | sort | xargs awk '
    FNR == 1 { name = FILENAME; sub(/^core\//, "", name); sub(/^include\//, "", name) }
    /^[ \t]*#[ \t]*include[ \t]*"/ { split($0, quoted, "\""); print name, quoted[2] }' | tsort >/dev/null
