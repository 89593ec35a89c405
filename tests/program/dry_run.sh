# bulla run --dry-run: everything up to the first step, exit code 0 or 2, and not a file written.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cat >bubble.yaml <<'END'
bulla: 1
title: A bubble
domain: {lower: [0, 0], upper: [1 mm, 1 mm], cells: [32, 32], boundaries: {x-: symmetry, x+: outflow, y-: symmetry, y+: outflow}}
mesh: {levels: 1, tile: 8, refine: [{interface: air}]}
materials:
  water: {eos: {type: stiffened-gas, preset: sg44}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 10 bar}
  - {sphere: {center: [0, 0], radius: 0.5 mm}, material: air, density: 1.2, pressure: 1 bar}
run: {until: 100 ns}
output: {directory: out/bubble, checkpoints: {every: 3 steps}}
END
expect() { # CODE TEXT ARGS...
    wanted=$1 text=$2 code=0
    shift 2
    "$BULLA" run bubble.yaml --dry-run "$@" >said 2>&1 || code=$?
    [ "$code" = "$wanted" ] || { echo "exit code $code, not $wanted: $*"; cat said; exit 1; }
    grep -q -e "$text" said || { echo "does not say '$text': $*"; cat said; exit 1; }
    [ -n "${there:-}" ] || [ ! -e out ] || { echo "something was written: $*"; find out; exit 1; }
}
expect 0 '^bubble.yaml: ready'
cp said one
grep -q 'fields .* alpha_air ' one
grep -q 'memory  *about .*iB' one
cells=$(sed -n 's/^  at the start 1024 + \([0-9]*\) cells$/\1/p' one)
[ "$cells" -ge 128 ] # the interface, buffered
dt=$(sed -n 's/.*the first step is \(.*\): .* steps of that size/\1/p' one)

# On several ranks: the same hierarchy, nothing else but their number differs.
expect 0 'ranks  *2$' -n 2
diff one said >difference || true
[ "$(grep -c '^[<>]' difference)" = 2 ] || { cat difference; exit 1; }

# The first step of the run is the one that was announced.
"$BULLA" run bubble.yaml --quiet --max-steps 4
first=$(sed -n 3p out/bubble/history.csv | cut -d, -f3)
printf '%s\n' "$first" | awk -v text="$dt" '{ split(text, part, " "); scale["ps"] = 1e-12; scale["ns"] = 1e-9
    exit !(sqrt(($1 / (part[1] * scale[part[2]]) - 1)^2) < 1e-3) }' || { echo "dt $first, announced $dt"; exit 1; }

# What would refuse the run refuses this.
there=yes
find out -type f -exec md5sum {} + | sort >before
expect 2 'out/bubble holds a run'
expect 0 ready --overwrite
expect 0 'from .*ns, step 3, until' --restart out/bubble/checkpoints/bubble_000003.chk -o elsewhere
expect 0 'step 4, until' --restart
find out -type f -exec md5sum {} + | sort >after
cmp before after
[ ! -e elsewhere ]
there=
rm -r out
expect 2 'max-memory' --max-memory 10kB
expect 2 'has no variants' --variant fast
expect 2 'unknown key' --set run.untill=3
expect 2 'boom' --set 'initial.0.pressure== (x < 0.0009) and 1e6 or error("boom")'
expect 2 'cannot read\|no such\|No such' --restart nowhere.chk
