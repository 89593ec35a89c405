# bulla sweep: every combination once, in its own directory, in one table; finished ones are recognised, failed ones do
# not end the sweep, and what is wrong is refused before anything runs.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
cat >base.yaml <<'END_OF_CASE'
bulla: 1
title: A tube
parameters: {p_1: 1 bar, x_0: 0.5}
domain: {lower: [0], upper: [1], cells: [32], boundaries: {x-: outflow, x+: reflecting}}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: = p_1}
  - {half-space: {point: [= x_0], normal: [1]}, material: air, density: 0.125, pressure: 0.1 bar}
run: {until: 0.5 ms}
output:
  directory: out/tube
  history: {columns: {m: {total: mass}, p: {max: pressure}}}
  probes: {wall: {at: [1], fields: [pressure]}}
expect:
  - {value: "last(p)/p_1", at-least: 0.9, label: "pressure, kept"}
  - {value: "last(step)", at-most: 30}
matrix:
  parameters.p_1: [1 bar, 20 kPa]
  domain.cells: [[32], [64]]
END_OF_CASE
printf 'extends: base.yaml\ntitle: Three\nmatrix: {scheme.limiter: [mc, minmod], domain.cells: [[32], [64]]}\nvariants: {short: {run: {until: 0.1 ms}}}\n' >tube.yaml
expect_code() { # CODE COMMAND...
    wanted=$1 got=0
    shift
    "$@" >stdout 2>stderr || got=$?
    [ "$got" = "$wanted" ] || { echo "exit code $got, wanted $wanted: $*"; cat stdout stderr; exit 1; }
}
says() { # TEXT [FILE]
    grep -q -e "$1" "${2:-stderr}" || { echo "'$1' not found"; cat "${2:-stderr}"; exit 1; }
}
field() { # LINE COLUMN of table.csv, whose names have no commas
    sed 's/"[^"]*"/quoted/g' "$3" | sed -n "$1p" | cut -d, -f"$2"
}

age() { find out -exec touch -d 2000-01-01 {} +; } # what is written later is newer, however soon

# A dry run lists the combinations in order and writes nothing.
expect_code 0 "$BULLA" sweep base.yaml --dry-run
[ "$(cat stdout)" = 'to be run               out/tube-sweep/p_1=1bar,cells=32
to be run               out/tube-sweep/p_1=1bar,cells=64
to be run               out/tube-sweep/p_1=20kPa,cells=32
to be run               out/tube-sweep/p_1=20kPa,cells=64' ] || { cat stdout; exit 1; }
[ ! -e out ]

# All combinations; two expectations fail with 64 cells.
expect_code 1 "$BULLA" sweep base.yaml -j 3 --value 'end = last(wall.pressure)/p_1' --value 'at(p, 1e-4)'
says '2 of 4 combinations do not show'
says '^ *p_1  cells  exit ' stdout
table=out/tube-sweep/table.csv
[ "$(head -n 1 $table)" = 'combination,parameters.p_1,domain.cells,exit,wall_s,cpu_s,cells_updated,"pressure, kept","pressure, kept: holds",last(step),last(step): holds,end,"at(p, 1e-4)"' ] || { cat $table; exit 1; }
[ "$(wc -l <$table)" = 5 ]
[ "$(field 2 2 $table),$(field 4 2 $table),$(field 3 3 $table)" = '100000,20000,[64]' ] # SI units
[ "$(field 2 4 $table),$(field 3 4 $table),$(field 2 11 $table),$(field 3 11 $table)" = 0,1,1,0 ]
[ "$(field 2 12 $table)" = "$(tail -n 1 'out/tube-sweep/p_1=1bar,cells=32/probes.csv' | awk -F, '{ printf "%.17g\n", $2 / 1e5 }')" ]
"$BULLA" run base.yaml -o alone --quiet --set 'parameters.p_1=20 kPa' --set domain.cells=[64] || [ $? = 1 ]
cmp alone/history.csv 'out/tube-sweep/p_1=20kPa,cells=64/history.csv'
cp $table first.csv

# What is finished is not run again, also when it has been moved and the rest is missing.
age
expect_code 1 "$BULLA" sweep base.yaml --value 'end = last(wall.pressure)/p_1' --value 'at(p, 1e-4)'
says '4 of them finished before'
cmp first.csv $table
mkdir -p far/away/in/a/folder/with/a/very/long/name/so/that/the/lines/of/the/resolved/case/are/broken/in/another/place
mv out/tube-sweep far/away/in/a/folder/with/a/very/long/name/so/that/the/lines/of/the/resolved/case/are/broken/in/another/place/here
moved=far/away/in/a/folder/with/a/very/long/name/so/that/the/lines/of/the/resolved/case/are/broken/in/another/place/here
rm -r "$moved/p_1=1bar,cells=64"
expect_code 1 "$BULLA" sweep base.yaml -o $moved
says '3 of them finished before'
[ -z "$(find "$moved" -name history.csv -newermt 2001-01-01 -not -path '*1bar,cells=64*')" ]

# Another case in the way: nothing is run, until it may be replaced; the others stay.
rmdir out && mkdir out
mv $moved out/tube-sweep
expect_code 2 "$BULLA" sweep base.yaml --set run.until=0.4ms
says "holds another run: its case has 'run: {until: 0.0005, .*}', now it would be 'run: {until: 0.0004, .*}'"
says '4 of 4 directories hold runs of another case'
"$BULLA" run base.yaml -o 'out/tube-sweep/p_1=1bar,cells=64' --quiet --overwrite --max-steps 3 --set domain.cells=[64]
expect_code 2 "$BULLA" sweep base.yaml
says '1 of 4 directories'
age
expect_code 1 "$BULLA" sweep base.yaml --overwrite
[ "$(find out -name history.csv -newermt 2001-01-01)" = 'out/tube-sweep/p_1=1bar,cells=64/history.csv' ]

# A file that extends another, a variant, the command line that changes the matrix.
expect_code 0 "$BULLA" sweep tube.yaml --dry-run
[ "$(wc -l <stdout)" = 8 ]
expect_code 0 "$BULLA" sweep tube.yaml --variant short -o short --set 'matrix[parameters.p_1]=null'
[ "$(cd short && echo *)" = 'limiter=mc,cells=32 limiter=mc,cells=64 limiter=minmod,cells=32 limiter=minmod,cells=64 sweep.lock table.csv' ] || { ls short; exit 1; }
says 'until: 0.0001' short/limiter=mc,cells=32/case.yaml
expect_code 2 "$BULLA" sweep base.yaml --set domain.cells=[16]
says "matrix\[domain.cells\]=null' takes it out"
expect_code 0 "$BULLA" sweep base.yaml --set 'matrix[domain.cells]=null' --set domain.cells=[16] --set 'matrix[parameters.p_1]=[1 bar, 2 bar]' \
    -o two -n 2 --quiet
[ ! -s stderr ] || { cat stderr; exit 1; }
grep -q '"ranks": 2' 'two/p_1=1bar/provenance.json'

# A combination that fails is reported, and the sweep goes on; a later call tries it again, and only it.
sed 's/pressure: = p_1}/pressure: = p_1, velocity: [= -v]}/; s/pressure: 0.1 bar}/pressure: 0.1 bar, velocity: [= v]}/; s/^parameters: {/&v: 0, /; s/^matrix:/&\n  parameters.v: [18 km\/s, 0]/' base.yaml >torn.yaml
expect_code 3 "$BULLA" sweep torn.yaml -o failing --set scheme.guard=strict --set 'matrix[parameters.p_1]=null' --set 'matrix[domain.cells]=[[32]]'
says '1 of 2 combinations failed'
says 'error: \[1/2\] v=18km-s,cells=32: failed with exit code 3: '
[ "$(field 2 4 failing/table.csv),$(field 3 4 failing/table.csv)" = 3,0 ]
says 'v  cells  exit' stdout

# Mistakes: in one combination, in a value, in the use.
expect_code 2 "$BULLA" sweep base.yaml -o bad --set 'matrix[scheme.limiter]=[mc, minmood]'
says "did you mean 'minmod'"
says 'in the combination p_1=1bar,cells=32,limiter=minmood'
expect_code 2 "$BULLA" sweep base.yaml -o bad --value 'min(q)'
says "there is no column, probe or parameter 'q'"
expect_code 2 "$BULLA" sweep base.yaml -o bad --value 'late = last(t) == 1 and mxa(p) or 0'
says "'last(t) == 1 and mxa(p) or 0', character 18: there is no function 'mxa'; did you mean 'max'?"
expect_code 2 "$BULLA" sweep base.yaml -o bad --value 'between(p, 1, 2)'
says 'whole column'
expect_code 2 "$BULLA" sweep base.yaml -o bad --set 'matrix[domain.cells]=[[32], [64], [32]]'
says 'the combinations 1 and 3 are the same'
expect_code 2 "$BULLA" sweep base.yaml -o bad --set matrix=null
says "no 'matrix:'"
expect_code 2 "$BULLA" sweep base.yaml -o bad -j 0
says 'at least 1'
expect_code 2 "$BULLA" sweep nowhere.yaml -o bad
expect_code 2 "$BULLA" sweep base.yaml --valeu 3
says 'did you mean --value'
[ ! -e bad ]

# Names that would be the same are told apart.
expect_code 0 "$BULLA" sweep base.yaml --dry-run -o names --set 'matrix[parameters.p_1]=["= 2*x_0", "= 2/x_0"]' --set 'matrix[domain.cells]=null'
[ "$(sort -u stdout | wc -l)" = 2 ] && says 'p_1=2-x_0~[0-9a-f]\{8\}$' stdout

# Whatever cannot be written ends the sweep with the reason.
printf 'a file' >taken
expect_code 3 "$BULLA" sweep base.yaml -o taken/here
says 'taken'

# Files in a matrix are found beside the case that holds it, wherever the sweep is started; those of --set from here.
mkdir waves
printf '0,1\n1e-6,2\n' | tee waves/weak.csv >waves/strong.csv
sed -e 's/x-: outflow/x-: {type: incoming-wave, pulse: series, file: weak.csv}/' -e '/^matrix:/,$d' base.yaml >waves/wave.yaml
echo 'matrix: {domain.boundaries.x-.file: [weak.csv, strong.csv]}' >>waves/wave.yaml
expect_code 0 "$BULLA" sweep waves/wave.yaml -o waves/out
[ "$(wc -l <waves/out/table.csv)" = 3 ]
grep -q "file: .*waves/strong.csv" waves/out/file=strong.csv/case.yaml || { cat waves/out/*/case.yaml; exit 1; }
expect_code 2 "$BULLA" run waves/wave.yaml --set domain.boundaries.x-.file=nowhere.csv
says 'nowhere.csv: No such file'
