# docs/tutorial.md as it stands there: its files, its commands in their order, with fewer cells and for a shorter time. Commands
# that wait for a reader (watch) are tested elsewhere.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
page=$BULLA_SOURCE/docs/tutorial.md
/usr/bin/python3 -c 'import numpy, h5py' 2>/dev/null || {
    echo "skipped: no python3-numpy or python3-h5py"
    exit 77
}
awk '/^```[a-z]/ { getline; name = $2; sub(/:$/, "", name); inside = 1 } /^```$/ { inside = 0 } inside { print > name }' "$page"
for file in hydrophone.csv stone.py stone.yaml peaks.py ball.yaml wall.yaml; do
    [ -s $file ] || fail "the page has no file $file"
done
shorter() { # FILE SED: must change it
    cp "$1" before
    sed -i "$2" "$1"
    ! cmp -s before "$1" || fail "nothing to shorten in $1 by $2" "$1"
}
shorter stone.yaml 's/cells: .*/cells: [16, 16, 16]/; s/until: .*}/until: 0.6 us}/; s/every: [^,]*,/every: 0.2 us,/'
shorter ball.yaml 's/cells: .[0-9]*./cells: [200]/; s/levels: [0-9]/levels: 1/'
shorter wall.yaml 's/cells: .*/cells: [32, 32]/; s/levels: [0-9]/levels: 1/; s/until: .*}/until: 0.2 us}/'

mkdir -p bin
printf '#!/bin/sh\nexec "%s" "$@"\n' "$BULLA" >bin/bulla
printf '#!/bin/sh\nexec /usr/bin/python3 "$@"\n' >bin/python3
chmod +x bin/*
PATH=$PWD/bin:$PATH
export PYTHONDONTWRITEBYTECODE=1
# What begins with a program, up to its last line.
awk '/^    (bulla|python3|cp|export) / || more { print; more = /\\$/ }' "$page" |
    sed "s|[.][.][.]/packaging|$BULLA_SOURCE/packaging|; s/ --time [^ ]*//; /bulla watch/d" >commands
[ "$(wc -l <commands)" -ge 12 ] || fail "where are the commands of the page?" commands
(. ./commands) >said 2>&1 || fail "a command of the page fails" said
for picture in stone.png tension.png wall.png; do
    [ -s $picture ] || fail "no $picture" said
done
grep -q 'largest tension in the stone: [0-9.e-]* MPa' said || fail "no figures of the stone" said
[ "$(sed -n 's/.*"ranks": \([0-9]*\).*/\1/p' out/stone/provenance.json)" = 2 ] || fail "not two ranks"
grep -q 'dropped\|cannot' said && fail "something went wrong" said || true
