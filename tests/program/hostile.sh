# Hostile input: each row is one file or setting that somebody could give by mistake or by malice. The program must
# end by itself with one clear line and the right code, on one rank and on two, without leaving a run behind when
# the case is refused. Prints the processor time that each took; a hang ends with code 124.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
made=$BULLA_BUILD/tests/hostile
data=$BULLA_SOURCE/tests/data

cat >good.yaml <<'CASE'
bulla: 1
title: A wave in a tube
domain:
  lower: [0]
  upper: [1 m]
  cells: [32]
  boundaries: {x-: reflecting, x+: reflecting}
mesh: {tile: 16}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1 bar}
  - {box: {lower: [0], upper: [0.5 m]}, material: air, density: 1.4, pressure: 2 bar}
run: {until: 1 ms, max-steps: 4}
output: {directory: out, checkpoints: {every: 2 steps}, history: {columns: {m: {mass: air}}}}
CASE

bad=0
complain() {
    echo "$name (-n $ranks): $1"
    head -c 2000 said.txt
    bad=$((bad + 1))
}

# What was said must be short, printable, and hold the words in one line that says error.
judge() { # NAME RANKS WANTED-CODE WORDS CODE MILLISECONDS
    name=$1 ranks=$2
    printf '%s %s %s %s\n' "$6" "$2" "$5" "$1" >>times.txt
    [ "$5" = "$3" ] || complain "exit $5, not $3"
    grep -a 'error' said.txt | grep -qaF -- "$4" || complain "no error line says '$4'"
    if grep -qaE 'Segmentation|Bus error|Sanitizer|backtrace|core dumped|Assertion' said.txt; then complain "it crashed"; fi
    [ "$(wc -l <said.txt)" -le 60 ] || complain "it says too much"
    [ "$(wc -L <said.txt)" -le 4100 ] || complain "a line is too long"
    if LC_ALL=C grep -qa "$(printf '[\001-\010\013-\037]')" said.txt; then complain "it prints control bytes"; fi
    if [ "$3" = 2 ] && [ -e out ]; then complain "the refused case left an output folder"; fi
    rm -rf out
}

cpu() { # sets $spent, milliseconds of processor time of all that this script has started and waited for
    times >spent.txt
    spent=$(awk -F '[ms ]+' 'NR == 2 { printf "%d", 60000 * ($1 + $3) + 1000 * ($2 + $4) }' spent.txt)
}
attempt() { # NAME RANKS WANTED-CODE WORDS ARGUMENTS...
    title=$1 count=$2 wanted=$3 words=$4
    shift 4
    [ "$count" = 1 ] || set -- "$@" -n "$count"
    cpu
    before=$spent
    complete timeout -k 5 "$lib_limit" "$BULLA" "$@" >said.txt 2>&1
    cpu
    judge "$title" "$count" "$wanted" "$words" "$code" "$((spent - before))"
}
once() { # WANTED-CODE WORDS ARGUMENTS...: named after its last argument
    wanted_code=$1 says=$2
    shift 2
    for last; do :; done
    attempt "$last" 1 "$wanted_code" "$says" "$@"
}
both() { # WANTED-CODE WORDS SETTINGS...: run good.yaml with the settings, on one rank and on two
    wanted_code=$1 says=$2
    shift 2
    for last; do :; done
    for ranks in 1 2; do
        attempt "$last" "$ranks" "$wanted_code" "$says" run good.yaml --quiet "$@"
    done
}
setting() { # WORDS SETTING: refused
    attempt "$2" 1 2 "$1" run good.yaml --quiet --set "$2"
}
repeat() { # COUNT TEXT
    awk -v n="$1" -v text="$2" 'BEGIN { for (i = 0; i < n; i++) printf "%s", text }'
}

# --- YAML ---
repeat 100000 '[' >nest.yaml
once 2 'nested too deeply' check nest.yaml
repeat 50000 '{a: ' >maps.yaml
once 2 'nested too deeply' check maps.yaml
awk 'BEGIN { for (i = 0; i < 500; i++) printf "%*sa:\n", i, "" }' >indent.yaml
once 2 'nested too deeply' check indent.yaml
awk 'BEGIN { print "a0: &a0 [x, x, x, x, x, x, x, x, x]"; for (i = 1; i < 10; i++) { printf "a%d: &a%d [", i, i
    for (k = 0; k < 9; k++) printf "*a%d,", i - 1; print "]" } }' >bomb.yaml
once 2 'too many' check bomb.yaml
awk 'BEGIN { for (i = 0; i < 40000; i++) printf "k%d: &a%d 1\n", i, i }' >anchors.yaml
once 2 'too many anchors' check anchors.yaml
yes 'a: 1' | head -c 100000000 >large.yaml
once 2 "'large.yaml' is larger than 1048576 bytes" check large.yaml
sed 's/^bulla: 1/&\nextends: large.yaml/' good.yaml >extends.yaml
once 2 "'large.yaml' is larger than" check extends.yaml
rm large.yaml
truncate -s 20G zeros.yaml
once 2 'is larger than' check zeros.yaml
printf 'bulla: 1\nbulla: 1\n' >twice.yaml
once 2 "key 'bulla' is already given in line 1" check twice.yaml
printf 'bulla: 1\ntitle: \303\050\n' >latin.yaml
once 2 'not a text in UTF-8' check latin.yaml
printf '\377\376b\000u\000' >utf16.yaml
once 2 'not a text in UTF-8' check utf16.yaml
printf 'bulla: 1\ntitle: a\000b\n' >zero.yaml
once 2 'error' check zero.yaml
printf 'bulla: 1\ndomain: "\\e[31mred\\u009b2J\\r\\n"\n' >escape.yaml
once 2 'domain' check escape.yaml
noise 100000 >noise.yaml
once 2 'error' check noise.yaml
once 2 "cannot read '.'" check .
mkfifo pipe.yaml
once 2 'pipe or a device' check pipe.yaml
once 2 'pipe or a device' check /dev/zero
sed 's/^bulla: 1/&\nextends: pipe.yaml/' good.yaml >extends.yaml
once 2 'extends.yaml:2:10: error: cannot read' check extends.yaml
sed 's/^bulla: 1/&\nextends: extends.yaml/' good.yaml >extends.yaml
once 2 'extends itself' check extends.yaml
odd=$(printf 'b\377d.yaml')
cp good.yaml "$odd"
once 2 'rename the file' run --quiet "$odd"

# --- numbers ---
for value in .nan .NaN nan inf -.inf 0x10 1_000 '1,5' 1e999 -1e999 "1e$(repeat 40 9)" "$(repeat 5000 9)" 1e-400 "''"; do
    setting 'error' "run.until=$value"
done
setting 'outside 1 to' 'domain.cells=[9223372036854775808]'
setting 'outside 1 to' 'domain.cells=[-1]'
setting 'an integer is needed' 'domain.cells=[2.5]'
setting 'the number is too large' 'initial.0.pressure=1e9999 bar'
setting 'is no state of' 'initial.0.pressure=1e308'
setting 'is outside 0 to 15' 'mesh.levels=4294967296'
setting 'is outside 4 to 256' 'mesh.tile=-2147483648'
both 2 'not admissible' --set 'initial.0.velocity=[1e200]'
attempt '-n 100000' 1 2 'ranks at most' run good.yaml --quiet -n 100000

# The same bits under a locale with a decimal comma.
run_as() { # FOLDER LOCALE
    LC_ALL=$2 "$BULLA" run good.yaml --quiet -o "$1" --set 'run.until=1.5e-4 s' --set 'output.history.columns.q={value: "t * 1.5"}'
}
if localedef -i de_DE -f UTF-8 "$PWD/de_DE.UTF-8" 2>/dev/null; then
    run_as plain C
    LOCPATH=$PWD run_as comma de_DE.UTF-8
    cmp plain/history.csv comma/history.csv
    rm -rf plain comma
fi

# --- Lua while the case is read ---
loop='while true do end'
for body in "$loop" "while true do pcall(function() $loop end) end" 'repeat local ok = pcall(error) until ok' \
    'for i = 1, math.huge do pcall(pcall, pcall, error) end' 'local function f() return f() end return f()' \
    'local function f() pcall(f) return f() end return f()' '::a:: goto a'; do
    attempt "$body" 1 2 'error' run good.yaml --quiet --set "initial.0.pressure== (function() $body end)()"
done
for body in 'local s = string.rep("x", 1e6) while true do s = s .. s end' 'local t, s = {}, string.rep(1, 1e5) for i = 1, 1e9 do t[i] = s .. i end' \
    'return string.rep("x", 1e18)' 'return #table.concat({}, "x", 1, 1e15)' 'return table.unpack({}, 1, 1e8)' \
    'local function f() return 1 + f() end return f()' 'return string.format("%99999999d", 1)' \
    'return os.execute("touch taken")' 'return io.open("taken", "w")' 'return require("os")' 'return load("x")' \
    'return debug.getregistry()' 'return setmetatable({}, {__gc = print})' 'return ("x"):find("(a*)*b")' \
    'return string.find("x", "(a*)*b")' 'return table.sort({})' 'return coroutine.create(print)' 'math.pi = 3' \
    'error({})' 'error(nil)' 'return {}' 'return nil' 'return "x"' 'return 0/0' 'return 1/0' 'return function() end'; do
    attempt "$body" 1 2 'error' run good.yaml --quiet --set "initial.0.pressure== (function() $body end)()"
done
[ ! -e taken ] || complain "a script reached the outside"
{
    sed '/^run:/,$d' good.yaml
    for i in 1 2 3 4 5 6 7 8 9 10 11 12; do
        echo "  - {box: {lower: [0], upper: [0.$((i + 10))]}, material: air, density: '= (function() $loop end)()', pressure: 1}"
    done
    echo 'run: {until: 1}'
} >loops.yaml
once 2 'ran for too long' check loops.yaml

echo 'return function(x) for i = 1, 1500000 do end return {pressure = 1e5} end' >slow.lua
both 2 'the scripts of the case ran for too long' --set domain.cells=[4096] --set 'initial.1={lua: slow.lua}'

# --- Lua while the run goes: each rank may see it alone ---
wave() {
    printf 'domain.boundaries.x-={type: incoming-wave, pulse: lua, lua: "function(t, x) if t > 0 then %s end return 0 end"}' "$1"
}
both 3 'ran for too long' --set "$(wave "$loop")"
both 3 'gives nan' --set "$(wave 'return 0/0')"
both 3 'not a text' --set "$(wave 'error({})')"
both 3 'not enough memory' --set 'run.script-time=100 s' --set "$(wave 'local t, s = {}, string.rep(1, 1e5) for i = 1, 1e9 do t[i] = s .. i end')"
both 3 'ran for too long' --set "output.history.columns.q={value: 't > 0 and (function() $loop end)() or 1'}"
both 2 'ran for too long' --set "initial.0.pressure== x > 0.9 and (function() $loop end)() or 1e5"
both 2 'gives nan' --set 'initial.0.pressure== x > 0.9 and 0/0 or 1e5'
both 2 'gives a table' --set 'initial.0.pressure== x > 0.9 and {} or 1e5'

# --- sources, states, exchange, surfaces: each mistake has its place ---
placed() { # NAME LINE:COLUMN WORDS: in new.yaml, said in one line
    attempt "$1" 1 2 "$3" run new.yaml --quiet
    grep -F "new.yaml:$2: error: " said.txt | grep -qF -- "$3" || complain "not said at $2"
}
sources() { # COLUMN WORDS VALUE: of line 16
    { cat good.yaml && printf 'sources: %s\n' "$3"; } >new.yaml
    placed "sources: $3" "16:$1" "$2"
}
sources 10 'sources: at least one source is needed' '{}'
sources 10 'sources: a map of keys is needed' '3'
sources 11 "unknown key 'heatng' in sources" '{heatng: 1}'
sources 23 "key 'heating' is already given" '{heating: 1, heating: 2}'
sources 20 "'1e9 J/m3' is a pressure, but a power per volume is needed" '{heating: 1e9 J/m3}'
sources 26 "'1 MPa' is a pressure" '{heating: {air: 1 MPa}}'
sources 26 'a power per volume is needed, not the text' '{heating: {air: .nan}}'
sources 20 'the script gives nan' '{heating: = 0/0}'
sources 20 'the script gives a table' '{heating: "= {}"}'
sources 26 "is a velocity, but an acceleration is needed" '{acceleration: [9.81 m/s]}'
sources 25 '1 component is needed, one per axis, not 2' '{acceleration: [1, 2]}'
sources 18 'a list is needed' '{force: 1}'
sources 25 "there is no material 'steam'" '{mass: {steam: 1}}'
sources 17 'a map with names as keys is needed' '{mass: 3}'
sources 22 'one material has no volume fraction' '{fractions: {air: 1}}'
sources 20 'a stretch is for solids' '{stretch: {xx: 1}}'
sources 16 "cannot read 'nowhere.lua'" '{lua: nowhere.lua}'
sources 16 'the script must return a function' '{lua: ""}'
both 3 'sources at (0.515625, 0, 0) m, in cell' --set 'sources={heating: = x > 0.5 and 0/0 or 1}'
for body in 'heating = 0/0' 'heating = "x"' 'force = {1, 2}' 'force = 1' 'heat = 1' 'mass = {steam = 1}'; do
    both 3 'step 1 at t = 0 s, level 0, tile (0, 0, 0), sources at' \
        --set "sources={lua: 'function(x, y, z, t) return {$body} end'}"
done
both 3 'must return a table of named fields' --set "sources={lua: 'function(x, y, z, t) return 3 end'}"
both 3 'ran for too long' --set "sources={lua: 'function(x, y, z, t) $loop end'}"
both 3 'no heat (called with' --set "sources={lua: 'function(x, y, z, t) if t > 0 then error(\"no heat\") end return {} end'}"
both 3 'partial_density_air = -' --set 'sources={mass: {air: -1e9}}'
both 3 'cannot be completed' --set 'sources={heating: -1e300}'

changed() { # LINE:COLUMN WORDS LINE TEXT: instead of that line
    sed "$3s|.*|$4|" good.yaml >new.yaml
    placed "$4" "$1" "$2"
}
state() { changed "$1" "$2" 12 "  - {everywhere: true, material: air, $3}"; }
state 12:83 'density and pressure make a state, and so a temperature' 'density: 1.2, pressure: 1 bar, temperature: 300'
state 12:56 "key 'pressure' is already given" 'pressure: 1 bar, pressure: 2 bar, temperature: 300'
state 12:71 "key 'density' is already given" 'temperature: 300, density: 1.2, density: 1.3'
state 12:5 'the pressure is missing' 'density: 1.2'
state 12:5 'the pressure is missing' 'temperature: 300'
state 12:52 "'C' in '26.85 C' is no unit" 'temperature: 26.85 C, pressure: 1 bar'
state 12:52 '0 K is not above 0' 'temperature: 0, pressure: 1 bar'
state 12:52 "is a pressure, but a temperature is needed" 'temperature: 300 Pa, pressure: 1 bar'
state 12:52 'the script gives nan' 'temperature: = 0/0, pressure: 1 bar'
state 12:52 'a temperature is needed, not a map' 'temperature: {air: 300}, pressure: 1 bar'
both 2 'the temperature is -3 K, not above 0' --set 'initial.0={everywhere: true, material: air, pressure: 1, temperature: = x > 0.5 and -3 or 300}'
changed 14:35 '-1 s is less than 0' 14 'run: {until: 1 ms, smallest-step: -1}'
changed 14:35 'is a length, but a time is needed' 14 'run: {until: 1 ms, smallest-step: 1 m}'
changed 8:20 "there is no 'slow' here" 8 'scheme: {exchange: slow}'
column() { changed "15:$1" "$2" 15 "output: {directory: out, history: {columns: {a: {$3}}}}"; }
column 66 "'in' is missing: the material whose surface it is" 'isosurface-min: temperature'
column 83 "there is no material 'steam'" 'isosurface-min: temperature, in: steam'
column 66 "there is no field 'heat'" 'isosurface-max: heat, in: air'
column 88 "unknown key 'level'" 'isosurface-max: temperature, in: air, level: 3'
column 85 "one measure per column: 'mean' is already given" 'mean: temperature, isosurface-min: pressure'
column 59 "there is no material 'steam'" 'outside: steam'
rm -f new.yaml

# --- modules ---
for flaw in bad_magic old_abi new_abi short_size no_table short_table null_slot unknown_kind missing_function no_symbol \
    small_symbol flush_to_zero duplicate aborts; do
    setting "$flaw.so" "modules=[$made/$flaw.so]"
done
both 2 'the moon is not full' --set "modules=[$made/open_fails.so]" --set 'scheme.limiter={type: hostile}'
both 2 'is damaged: trying to load it ended with SIGABRT' --set "modules=[$made/aborts.so]"
both 2 'gives no finite slopes' --set "modules=[$made/nan/nan_limiter.so]" --set 'scheme.limiter=nan'
both 2 'gives no finite edges' --set "modules=[$made/nan/nan_reconstruction.so]" --set 'scheme.reconstruction=nan'
both 2 'gives no finite fluxes' --set "modules=[$made/nan/nan_riemann.so]" --set 'scheme.riemann=nan'
gas="modules=[$made/nan/nan_eos.so]"
both 2 'is no state of' --set "$gas" --set materials.air.eos=nan --set 'initial.1.pressure=4 bar'
both 3 'cannot be completed' --set "$gas" --set materials.air.eos=nan --set 'initial.0.velocity=[-900]' \
    --set run.max-steps=200
solid="modules=[$made/nan/nan_constitutive.so]"
both 2 "nan J/kg by the elastic law 'nan' of material 'air' at I1 = 25.4" --set "$solid" --set materials.air.constitutive=nan \
    --set 'initial.1.stretch=[5, 0.4472136, 0.4472136]'
both 3 "nan J/kg by the elastic law 'nan' of material 'air' at I1 = 18." --set "$solid" --set materials.air.constitutive=nan --set run.max-steps=200 \
    --set 'initial.1.stretch=[4.185, 0.4888231, 0.4888231]' --set 'initial.1.velocity=[= 2e4 * x]'
for length in 0 10 1000 8000; do
    head -c "$length" "$made/none.so" >cut.so
    setting 'error' 'modules=[cut.so]'
done
for object in pipe.yaml /dev/zero . good.yaml nowhere.so zeros.yaml; do setting 'modules[0]: ' "modules=[$object]"; done

# --- tables ---
series() { # WORDS: for series.csv
    attempt "$1" 1 2 "$1" run good.yaml --quiet --set \
        'domain.boundaries.x-={type: incoming-wave, pulse: series, file: series.csv, columns: [1, 2]}'
}
printf '0,1\n1e-6,2\n2e-6' >series.csv
series 'series.csv:3: fewer than 2 columns'
printf '0,1\n1e-6,nan\n' >series.csv
series "'nan' is not a number"
printf '0;1\n1e-6;2,5\n' >series.csv
series "the decimal point is '.'"
printf '0,1\n2e-6,1\n1e-6,1\n' >series.csv
series 'must ascend'
printf '0,1\n1e-6,\0001\n' >series.csv
series 'not a text file'
printf 't,p\n' >series.csv
series 'no numbers in this file'
repeat 100000 1 >series.csv
series 'longer than'
noise 5000 >series.csv
series 'series.csv:'
rm series.csv
mkfifo series.csv
series 'pipe or a device'
rm series.csv
ln -s /dev/zero series.csv
series 'pipe or a device'
rm series.csv

# --- checkpoints ---
"$BULLA" run good.yaml --quiet -o whole
newest=whole/checkpoints/good_000004.chk
size=$(wc -c <"$newest")
taken_up() { # RANKS WORDS FILE SETTINGS...
    on=$1 words=$2 file=$3
    shift 3
    for ranks in $on; do attempt "$file" "$ranks" 2 "$words" run good.yaml --quiet "--restart=$file" "$@"; done
}
for length in 0 100 4095 4096 $((size - 1)); do
    head -c "$length" "$newest" >cut.chk
    taken_up 1 'cut.chk: ' cut.chk
done
for place in 3 17 30 64 4090 4100 $((size / 2)) $((size - 1)); do
    cp "$newest" flipped.chk
    byte=$(od -An -tu1 -j "$place" -N 1 "$newest" | tr -d ' ')
    printf "\\$(printf %o $((byte ^ 4)))" | dd of=flipped.chk bs=1 seek="$place" conv=notrunc 2>/dev/null
    taken_up 1 'flipped.chk: ' flipped.chk
done
taken_up 2 'cut.chk: ' cut.chk
taken_up 2 'flipped.chk: ' flipped.chk
taken_up '1 2' 'another case' "$newest" --set 'domain.cells=[64]'
taken_up 1 'another case' "$newest" --set materials.air.eos.gamma=1.3
for file in pipe.yaml /dev/zero . nowhere zeros.yaml whole/history.csv whole/fields/good_000004.hdf; do
    attempt "--restart=$file" 1 2 'cannot restart' run good.yaml --quiet "--restart=$file"
done

mkdir out out/checkpoints
cp whole/checkpoints/good_000002.chk out/checkpoints
mkfifo out/history.csv
attempt out/history.csv 1 3 'it is a pipe' run good.yaml --quiet --restart

# --- what `plot` is given: no history and no case that never ends ---
mkdir piped
mkfifo piped/history.csv piped/case.yaml
attempt plot-history 1 3 'it is a pipe' plot piped history

# --- snapshots and what `info` is given ---
snapshot=whole/fields/good_000004.hdf
size=$(wc -c <"$snapshot")
for length in 0 100 2000 $((size / 2)) $((size - 1)); do
    head -c "$length" "$snapshot" >cut.hdf
    once 2 'cut.hdf: ' info cut.hdf
done
for file in pipe.yaml /dev/zero . nowhere zeros.yaml good.yaml cut.chk flipped.chk; do once 2 "$file" info "$file"; done

echo "milliseconds of processor time, ranks, exit code, what: the slowest"
sort -rn times.txt | head -n 12
awk '{ n[$2]++; sum[$2] += $1 } END { for (r in n) printf "%d rows on %d rank(s), mean %d ms\n", n[r], r, sum[r] / n[r] }' times.txt
[ "$bad" = 0 ] || { echo "$bad complaints"; exit 1; }
