# A measured pulse in the units of whoever measured it: the header or `units:` says which, `amplitude:` and `scale:` say
# how strong it is. All ways of writing one pulse give the same run, to the bit.
set -eu
cat >base.yaml <<'END'
bulla: 1
title: A measured pulse
domain:
  lower: [0]
  upper: [500 um]
  cells: [128]
  boundaries:
    x-: {type: incoming-wave, pulse: sine, amplitude: 1 MPa, frequency: 5 MHz, delay: 20 ns}
    x+: non-reflecting
materials: {water: {eos: {type: stiffened-gas, preset: sg44}}}
initial: [{everywhere: true, material: water, density: 998.2, pressure: 1 atm}]
run: {until: 100 ns}
output: {history: {columns: {p_max: {max: pressure}, impulse: {integral: pressure}, twice: {value: 2 * p_max}}}}
END
cat >measured.yaml <<'END'
extends: base.yaml
domain: {boundaries: {x-: {pulse: series, file: pulse.csv}}}
END
pulse() { # HEADER SEPARATOR FACTOR-OF-TIME FACTOR-OF-PRESSURE
    printf '%s\n' "$1"
    awk -v s="$2" -v t="$3" -v p="$4" 'BEGIN {
        split("0 13 40 77 120", ts); split("0 2 5 -3 0", ps)
        for (i = 1; i <= 5; i++) printf "%.17g%s%.17g\n", ts[i] * t, s, ps[i] * p }'
}
same() { # WHAT ARGS...: the run of measured.yaml is that of SI
    what=$1
    shift
    "$BULLA" run measured.yaml -o out --overwrite --quiet "$@" 2>said || { echo "$what: refused"; cat said; exit 1; }
    cmp out/history.csv si/history.csv || { echo "$what: another pulse"; exit 1; }
}
awk 'BEGIN { print "t,p"; split("0e-9 13e-9 40e-9 77e-9 120e-9", ts, " "); split("0 2e6 5e6 -3e6 0", ps, " ")
    for (i = 1; i <= 5; i++) print ts[i] "," ps[i] }' >pulse.csv
"$BULLA" run measured.yaml -o si --quiet
[ "$(tail -n 1 si/history.csv | cut -d, -f4 | cut -c1)" -ge 4 ] # MPa: the pulse is in the domain
same 'the same file'
pulse t_ns,p_MPa , 1 1 >pulse.csv
same 'units behind _'
pulse 'time_ns;p (MPa)' ';' 1 1 >pulse.csv
same 'units in brackets'
pulse 't [ns]	p [MPa]' '	' 1 1 >pulse.csv
same 'blanks before brackets' --set 'domain.boundaries.x-.columns=[t, p]'
pulse '# columns: t[ns], p[MPa]' , 1 1 >pulse.csv
same 'units in a comment'
pulse t,p , 1 1 >pulse.csv
same 'units in the case' --set 'domain.boundaries.x-.units={t: ns, p: MPa}'
same 'units as a list' --set 'domain.boundaries.x-.units=[ns, MPa]'
pulse 't [s],p [bar]' , 1 1 >pulse.csv
same 'the case wins over the header' --set 'domain.boundaries.x-.units=[ns, MPa]'
pulse 't_ns,u (V)' , 1 1 >pulse.csv
same 'volts and an amplitude' --set 'domain.boundaries.x-.amplitude=5 MPa'
pulse 't_ns,p_max' , 1 1 >pulse.csv
same 'no unit behind _, and a scale' --set domain.boundaries.x-.scale=1e6

# The units of the table are beside it.
printf '%s\n' file,column,unit history.csv,step,1 history.csv,t,s history.csv,dt,s history.csv,p_max,Pa \
    'history.csv,impulse,Pa m' history.csv,twice, history.csv,guard_fallback,1 history.csv,guard_relaxed,1 \
    history.csv,guard_clipped,1 history.csv,guard_retries,1 | cmp - out/columns.csv

refused() { # PATTERN ARGS...
    pattern=$1
    shift
    code=0
    "$BULLA" check measured.yaml "$@" >said 2>&1 || code=$?
    [ "$code" = 2 ] && grep -qF -- "$pattern" said || { echo "exit code $code, no '$pattern'"; cat said; exit 1; }
}
pulse 't_ns,u (V)' , 1 1 >pulse.csv
refused "'V' is no unit of a pressure"
grep -q "at column 'u (V)'; 'units: {t: us, p: MPa}' wins over it" said
refused "'mm' is no unit of a time" --set domain.boundaries.x-.units.t=mm
refused "either 'amplitude' or 'scale', not both" --set domain.boundaries.x-.units.p=Pa \
    --set domain.boundaries.x-.amplitude=1 --set domain.boundaries.x-.scale=2
pulse t_ns,p , 1 0 >pulse.csv
refused 'a pulse of zeros cannot be given an amplitude' --set domain.boundaries.x-.amplitude=1

# Two unknown fields are two mistakes, and no field without a name is listed twice.
sed -i 's/^output: {/&snapshots: {every: 1 us, fields: [presure, densty, pressure, pressure]}, /' base.yaml
pulse t_ns,p_MPa , 1 1 >pulse.csv
refused "there is no field 'densty'"
grep -q "there is no field 'presure'" said
[ "$(grep -c 'is listed twice' said)" = 1 ] && grep -q "'pressure' is listed twice" said || { cat said; exit 1; }
