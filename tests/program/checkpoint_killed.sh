# A run that is killed (kill -9) at random moments, on one rank and on several, one rank of them or all: it can always
# be taken up, loses one interval of checkpoints at most, and in the end has the bits of a run that nobody touched.
# BULLA_KILLS: how often (24).
set -eu
same="$BULLA_BUILD/tests/test-unit-checkpoint"
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" # Open MPI leaks by itself
every=3
cat >bubble.yaml <<END
bulla: 1
title: A bubble
domain:
  geometry: axisymmetric
  lower: [0, -1 mm]
  upper: [1 mm, 1 mm]
  cells: [16, 32]
  boundaries: {x-: axis, x+: outflow, y-: reflecting, y+: outflow}
mesh: {tile: 8, levels: 1, refine: [{interface: air}]}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: 10 bar}
  - {sphere: {center: [0, 0], radius: 0.5 mm}, material: air, density: 1.2, pressure: 1 bar}
run: {until: 1, max-steps: 300}
output:
  directory: out
  snapshots: {every: 20 steps}
  checkpoints: {every: $every steps}
  history: {columns: {V: {volume: air}, depth: {penetration: air}}}
  probes: {every: 10 ns, top: {at: [0.3 mm, 0.3 mm], fields: [pressure]}}
END

number() { od -An -N2 -tu2 /dev/urandom | awk -v most="$1" '{ print $1 % most }'; }
descendants() { # PID: the process and all below it
    echo "$1"
    for child in $(ps -o pid= --ppid "$1"); do descendants "$child"; done
}
strike() { # PID HOW: everything, or one rank
    victims=$(descendants "$1")
    if [ "$2" = rank ]; then
        ranks=$(for pid in $victims; do ps -o pid=,args= -p "$pid"; done | awk '/[b]ulla run/ { print $1 }' | tail -n +2)
        [ -z "$ranks" ] || victims=$(echo "$ranks" | tail -n "$((1 + $(number 2)))" | head -n 1)
    fi
    # shellcheck disable=SC2086
    kill -9 $victims 2>/dev/null || true
}
step_of() { basename "$1" .chk | sed 's/.*_0*\([0-9]\)/\1/'; }
judge() { # after a kill: the newest whole checkpoint is not far behind the last row
    row=$(tail -n 2 out/history.csv | grep '^[0-9]*,.*,.*,.*,.*,.*,.*,.*,' | tail -n 1 | cut -d, -f1)
    newest=0
    for file in out/checkpoints/*.chk; do
        [ -e "$file" ] || continue
        "$BULLA" info "$file" >info.txt 2>&1 || { cat info.txt; echo "a checkpoint under its name is damaged"; exit 1; }
        [ "$(step_of "$file")" -le "$newest" ] || newest=$(step_of "$file")
    done
    [ "$((${row:-0} - newest))" -le "$every" ] || { echo "row $row, but checkpoint $newest"; exit 1; }
}
finish() {
    cmp whole/history.csv out/history.csv
    cmp whole/probes.csv out/probes.csv
    cmp whole/fields/bubble.hdf.series out/fields/bubble.hdf.series
    "$same" whole/checkpoints/bubble_000300.chk out/checkpoints/bubble_000300.chk
}

"$BULLA" run bubble.yaml --quiet
mv out whole
kills=0
late=0 # a rank that started while the others were killed holds the directory until it notices
while [ "$kills" -lt "${BULLA_KILLS:-24}" ]; do
    ranks=1 how=all # mostly: starting MPI takes longer than the run
    if [ "$(number 4)" = 0 ]; then
        ranks=$((2 + $(number 3)))
        [ "$(number 2)" = 0 ] || how=rank
    fi
    restart=--restart
    ls out/checkpoints/*.chk >/dev/null 2>&1 || restart=--overwrite
    "$BULLA" run bubble.yaml -n $ranks --quiet $restart >said 2>&1 &
    run=$!
    sleep "0.$((10 + $(number $((20 * ranks)))))"
    if kill -0 $run 2>/dev/null; then
        strike $run $how
        kills=$((kills + 1))
    fi
    code=0
    wait $run || code=$?
    case $how-$code in
    *-0) # it was faster
        finish
        rm -rf out
        continue
        ;;
    all-137 | rank-137) ;;
    rank-3) grep -q 'a rank ended without finishing\|error' said || { cat said; exit 1; } ;;
    *-2)
        late=$((late + 1))
        grep -q 'another run is at work' said && [ "$late" -le 20 ] || { cat said; exit 1; }
        sleep 1
        continue
        ;;
    *) echo "exit code $code on $ranks ranks ($how)"; cat said; exit 1 ;;
    esac
    [ ! -e out ] || judge
done
[ ! -d out ] || "$BULLA" run bubble.yaml --quiet "$(ls out/checkpoints/*.chk >/dev/null 2>&1 && echo --restart || echo --overwrite)"
[ ! -d out ] || finish
