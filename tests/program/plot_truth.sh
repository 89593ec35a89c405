# Pictures that say what the run did: interfaces of materials that were not stored, times, names of files and runs,
# references over histories, sizes that films can have.
set -eu
unset DISPLAY || true
. "$BULLA_SOURCE/tests/lib.sh"
even() { # FILE...: width and height of each PNG
    for file in "$@"; do
        od -An -tu1 -j16 -N8 "$file" | awk '{ exit $4 % 2 || $8 % 2 }' || fail "odd size: $file"
    done
}
refused() { # PATTERN COMMAND...: exit code 2 and one line that says PATTERN
    pattern=$1 code=0
    shift
    "$@" >out 2>err || code=$?
    [ "$code" = 2 ] || fail "exit code $code: $*" err
    grep -q -- "$pattern" err || fail "no '$pattern' in:" err
    [ "$(wc -l <err)" = 1 ] || fail "more than a line:" err
}
case_file() { # NAME FIELDS: a bubble and a drop in water
    cat >"$1.yaml" <<CASE
bulla: 1
title: A bubble and a drop
about: for pictures
cite: none
domain:
  geometry: cartesian
  lower: [0, 0]
  upper: [1 mm, 1 mm]
  cells: [32, 32]
  boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  oil: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
initial:
  - {everywhere: true, material: water, density: 998.2, pressure: 35 MPa}
  - {sphere: {center: [0.3 mm, 0.3 mm], radius: 0.2 mm}, material: air, density: 1.225, pressure: 35 MPa}
  - {sphere: {center: [0.7 mm, 0.7 mm], radius: 0.2 mm}, material: oil, density: 900, pressure: 35 MPa}
scheme: {closure: kapila, riemann: hllc, limiter: mc, cfl: 0.4}
run: {until: 20 ns}
output:
  snapshots: {every: 10 ns, fields: [$2]}
  history: {every: 1 step, columns: {V: {volume: air}, pmax: {max: pressure}}}
CASE
    "$BULLA" run "$1.yaml" -o "$1" --quiet
}

# The picture is the same whichever fraction the snapshots lack: it is what the others leave.
case_file all 'pressure, density, alpha_water, alpha_air, alpha_oil'
case_file most 'pressure, density, alpha_water, alpha_air'
case_file one 'pressure, alpha_air'
"$BULLA" plot all pressure -o all.png 2>err
"$BULLA" plot most pressure -o most.png 2>>err
[ ! -s err ] || fail "a word too much" err
"$BULLA" plot all pressure --contour none -o bare.png
cmp all.png most.png || fail "the interface of what was not stored is another one"
! cmp -s all.png bare.png || fail "no interface"
"$BULLA" plot all pressure --contour oil -o oil.png
"$BULLA" plot most pressure --contour oil -o rest.png
"$BULLA" plot one pressure --all -o . >out 2>err
[ "$(cat err)" = "note: interfaces of materials whose fraction is not in the snapshots are not drawn: alpha_water, \
alpha_oil; list them in output: snapshots: fields: (one may be left out)" ] || fail "not this note" err
"$BULLA" plot one pressure --contour none -o bare.png 2>err
[ ! -s err ] || fail "a note about what nobody wants" err
refused "have no alpha_oil, and it is not the only one" "$BULLA" plot one pressure --contour oil

# A file for each field, none over another.
[ "$("$BULLA" plot all pressure,density -o x.png | tr '\n' ' ')" = "x_pressure.png x_density.png " ]
! cmp -s x_pressure.png x_density.png || fail "two fields, one picture"
[ ! -e x.png ]
mkdir -p a.b
[ "$("$BULLA" plot all pressure,density -o a.b/x | tail -n 1)" = a.b/x_density ]

# Times within half an interval of the snapshots (0, 10, 20 ns).
"$BULLA" plot all pressure --time 24ns -o near.png
cmp near.png all.png || fail "24 ns is nearest to the last snapshot"
refused "the snapshots reach from 0 s to 2e-08 s; did you mean --time 2e-08" "$BULLA" plot all pressure --time 26ns
refused "did you mean --time 0?" "$BULLA" plot all pressure --time -6ns

# Sizes for films, whatever the width asked for.
"$BULLA" plot all pressure --width 501 -o odd.png
"$BULLA" plot all history --width 333 -o history.png
"$BULLA" plot all pressure --slice y=0.3mm -o line.png
even all.png odd.png history.png line.png x_pressure.png

# References over a history.
awk 'BEGIN { print "# a comment\nt,V,p0"; for (i = 0; i < 9; i++) print i * 2.5e-9 "," 1.2e-7 "," 1e7 * i }' >ref.csv
"$BULLA" plot all history V pmax -o plain.png
"$BULLA" plot all history V pmax --over ref.csv -o over.png
"$BULLA" plot all history V pmax --over ref.csv:t,p0 -o first.png
"$BULLA" plot all most history V --over ref.csv --over ref.csv:t,p0 -o two.png
for file in over first two; do ! cmp -s "$file.png" plain.png || fail "no reference in $file"; done
! cmp -s over.png first.png || fail "another column, the same picture"
even over.png two.png
refused "no column 'pp' (did you mean 'p0'?); there are: t, V, p0" "$BULLA" plot all history V --over ref.csv:t,pp
refused "no column 'tt' (did you mean 't'?); there are: t, V, p0" "$BULLA" plot all history V --over ref.csv:tt,V
refused "none of the columns drawn is in it; there are: t, V, p0" "$BULLA" plot all history pmax --over ref.csv
refused "none.csv: No such file" "$BULLA" plot all history V --over none.csv
printf '# only words\nt,V\n' >empty.csv
refused "no rows" "$BULLA" plot all history V --over empty.csv
printf 't,V\n1,2\n3,x\n' >bad.csv
refused "bad.csv:3: not a row" "$BULLA" plot all history V --over bad.csv
refused "references go over histories" "$BULLA" plot all pressure --over ref.csv

# The report: units, what counts mean, a page for phones, snapshots to step through without a script.
"$BULLA" report all -o report.html
has() { grep -q -- "$1" report.html || fail "the report lacks: $1"; }
has 'content="width=device-width, initial-scale=1"'
has 'guard: relaxed<small>mixed cells'
has 'peak memory<small>of all ranks together</small></span><b>[0-9.]* MB</b>'
has '<tr><td>V</td><td>m²</td>'
has '<tr><td>pmax</td><td>Pa</td><td>3.5e+07</td>'
has 'Against time \[s\]: V \[m²\], pmax \[Pa\]</figcaption>'
has '<figcaption>density \[kg/m³\] at t = 20.0 ns</figcaption>'
has '<b>2 of 3, t = 10.0 ns</b><label for="step-2">next'
[ "$(grep -c '<figure>' report.html)" = "$(grep -c '<figcaption>' report.html)" ]
[ "$(grep -c 'type="radio" name="step"' report.html)" = 3 ]
[ "$(grep -c ' checked ' report.html)" = 1 ]
for frame in 0 1 2; do has "id=\"step-$frame\""; done
! grep -qE '<script|src="[^d]|href=' report.html || fail "something from outside"
[ "$("$BULLA" report one/)" = one/report.html ]
grep -q 'are not drawn: alpha_water, alpha_oil\.' one/report.html || fail "no word of what is not drawn"
