# A run that is killed (kill -9) at moments that are drawn, on one rank and on several, with one writer and with more, one
# rank of them or all: it can always
# be taken up, loses one interval of checkpoints at most, and in the end has the bits of a run that nobody touched.
# BULLA_KILLS: how often (24).
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
same="$BULLA_BUILD/tests/test-unit-checkpoint"
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

rows() { cat out/history.csv 2>/dev/null | wc -l; }
draw_moment() { # how far the run comes before it is struck
    draw 8
    case $drawn in
    0) moment=start ;;
    1) moment=ranks ;;
    2) moment=files ;;
    3) moment=draft ;;
    *) draw 90 && moment=$(($(rows) + drawn)) ;;
    esac
}
reached() { # the moment, or the end
    alive "$run" || return 0
    case $moment in
    start) ;;
    ranks) [ "$(ranks_of "$run" | wc -l)" = "$ranks" ] ;;
    files) [ -e out/history.csv ] ;;
    draft) ls out/checkpoints/*.tmp >/dev/null 2>&1 ;;
    *) [ "$(rows)" -ge "$moment" ] ;;
    esac
}
moved() { # all ranks are there: mpirun does not hear of one that dies while MPI starts; or the end
    alive "$run" || return 0
    [ "$(rows)" -gt "$before" ]
}
ranks_of() { # SESSION
    [ "$ranks" -gt 1 ] || { echo "$1"; return; }
    ps -o pid=,comm=,stat= -s "$1" | awk -v first="$1" '$2 == "bulla" && $3 !~ /^Z/ && $1 != first { print $1 }'
}
strike() { # everything, or one rank, of which the others hear
    draw "$ranks"
    victim=
    [ $how = all ] || victim=$(ranks_of "$run" | tail -n +$((drawn + 1)) | head -n 1)
    if [ -n "$victim" ]; then
        kill -9 "$victim" 2>/dev/null || true
        if lingers "$run"; then # mpirun may hang on its way out
            how=all
            killed "$run"
        else
            ended "$run"
        fi
    else
        killed "$run"
    fi
}
step_of() { basename "$1" .chk | sed 's/.*_0*\([0-9]\)/\1/'; }
judge() { # after a kill: the newest whole checkpoint is not far behind the last row
    row=$(tail -n 2 out/history.csv | grep '^[0-9]*,.*,.*,.*,.*,.*,.*,.*,' | tail -n 1 | cut -d, -f1)
    newest=0
    for file in out/checkpoints/*.chk; do
        [ -e "$file" ] || continue
        "$BULLA" info "$file" >info.txt 2>&1 || fail "a checkpoint under its name is damaged" info.txt
        [ "$(step_of "$file")" -le "$newest" ] || newest=$(step_of "$file")
    done
    [ "$((${row:-0} - newest))" -le "$every" ] || fail "row $row, but checkpoint $newest"
}
finish() {
    cmp whole/history.csv out/history.csv
    cmp whole/probes.csv out/probes.csv
    cmp whole/fields/bubble.hdf.series out/fields/bubble.hdf.series
    "$same" whole/checkpoints/bubble_000300.chk out/checkpoints/bubble_000300.chk
}

"$BULLA" run bubble.yaml --quiet
mv out whole
kills=0 rounds=0
while [ "$kills" -lt "${BULLA_KILLS:-24}" ]; do
    rounds=$((rounds + 1))
    [ $rounds -le $((20 * ${BULLA_KILLS:-24})) ] || fail "only $kills kills in $rounds runs"
    ranks=1 writers=1 how=all # mostly: starting MPI takes longer than the run
    draw 4
    if [ "$drawn" = 0 ]; then
        draw 3 && ranks=$((2 + drawn))
        draw "$ranks" && writers=$((1 + drawn))
        draw 2 && [ "$drawn" = 0 ] || how=rank
    fi
    restart=--restart
    ls out/checkpoints/*.chk >/dev/null 2>&1 || restart=--overwrite
    draw_moment
    before=$(rows)
    start "$BULLA" run bubble.yaml -n $ranks --writers $writers --quiet $restart >said 2>&1
    await "$moment" reached
    [ $how = all ] || await "a row of this run" moved
    strike
    case $how-$code in
    *-0) # it was faster
        finish
        rm -rf out
        continue
        ;;
    all-137 | rank-137) ;;
    rank-3) grep -q 'a rank ended without finishing\|error' said || fail "no reason is given" said ;;
    *) fail "exit code $code on $ranks ranks ($how, $moment)" said ;;
    esac
    kills=$((kills + 1))
    [ ! -e out ] || judge
done
echo "$kills kills in $rounds runs"
[ ! -d out ] || "$BULLA" run bubble.yaml --quiet "$(ls out/checkpoints/*.chk >/dev/null 2>&1 && echo --restart || echo --overwrite)"
[ ! -d out ] || finish
