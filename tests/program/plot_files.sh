# Charts and reports from files alone: no run is needed, CSV and JSON by hand do.
set -eu
unset DISPLAY || true
png_width() { # width in pixels, from the header of a PNG
    od -An -tu1 -j16 -N4 "$1" | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4 }'
}
refused() { # PATTERN COMMAND...: exit code 2 and one line that says PATTERN
    pattern=$1
    shift
    code=0
    "$@" >out 2>err || code=$?
    [ "$code" = 2 ] || { echo "exit code $code: $*"; cat err; exit 1; }
    grep -q -- "$pattern" err || { echo "no '$pattern' in:"; cat err; exit 1; }
    [ "$(wc -l <err)" = 1 ] || { echo "more than a line:"; cat err; exit 1; }
}

rm -rf dir empty && mkdir dir empty
awk 'BEGIN {
    print "step,t,dt,V,pmax,guard_fallback"
    for (i = 0; i < 500; i++) printf "%d,%.17g,1e-9,%.17g,%.17g,0\n", i, i * 1e-9, 4e-15 * (1 - i / 600), 1e5 * (1 + i)
}' >dir/history.csv
printf 't,wall.pressure,wall.velocity_y\n0,1e5,0\n1e-9,2e5,1\n2e-9,3e5,4\n' >dir/probes.csv
printf 'title: A <case> & more\nabout: "What it is"\n' >dir/case.yaml
printf '{"version": "1", "steps": 500, "cells": 42.0, "exit_reason": "finished"}' >dir/provenance.json
printf '{"passed": false, "expectations": [{"what": "min(V)", "value": 1.5, "bound": "<= 1", "passed": false},
    {"what": "at(V, 9)", "value": null, "fault": "the run ended <before>", "bound": "<= 1", "passed": false}]}' \
    >dir/expect.json

[ "$("$BULLA" plot dir history --width 640)" = dir/plots/history.png ]
[ "$(png_width dir/plots/history.png)" = 640 ]
"$BULLA" plot dir history wall.pressure wall.velocity_y --xlim 0,2ns -o probes.png
[ "$(png_width probes.png)" -gt 1000 ]

refused "no column 'vmax' (did you mean 'pmax'?)" "$BULLA" plot dir history vmax
refused "no directory nowhere" "$BULLA" plot nowhere pressure
refused "no list of snapshots" "$BULLA" plot dir pressure
refused "no history.csv" "$BULLA" plot empty history
refused "which field" "$BULLA" plot dir
refused "did you mean --range" "$BULLA" plot dir pressure --rang 1,2
refused "'deep' is no number" "$BULLA" plot dir pressure --slice z=deep
refused "no provenance.json" "$BULLA" report empty
[ ! -e empty/plots ] # nothing is left behind

[ "$("$BULLA" report dir/)" = dir/report.html ]
grep -q '<title>A &lt;case&gt; &amp; more</title>' dir/report.html
grep -q 'class="fail">FAIL' dir/report.html
grep -q '<td>the run ended &lt;before&gt;</td>' dir/report.html
[ "$(grep -c 'src="data:image/png;base64,iVBORw0KGgo' dir/report.html)" = 2 ] # history and probes
! grep -qE 'src="[^d]|href=' dir/report.html # nothing from outside

# The pictures in the page are whole PNG files.
sed -n 's/.*src="data:image\/png;base64,\([^"]*\)".*/\1/p' dir/report.html | head -n 1 | base64 -d >inside.png
[ "$(png_width inside.png)" = 900 ]
tail -c 8 inside.png | od -An -tx1 | grep -q '49 45 4e 44 ae 42 60 82'
