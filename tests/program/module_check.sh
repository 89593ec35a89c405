# bulla module check: every built-in module, the plugin and the skeletons hold their contract; each hostile file
# is refused in one line; what ends the process, crashes or never comes back is told, and nothing hangs.
set -eu
fail() {
    echo "$1"
    cat out err
    exit 1
}
judge() { # CODE FILE...
    wanted=$1
    shift
    code=0
    "$BULLA" module check "$@" >out 2>err || code=$?
    [ "$code" = "$wanted" ] || fail "$*: exit code $code, not $wanted"
}

# A law that lives in a file gets one: modified NASG water on a grid.
awk 'BEGIN {
    print "rho[kg/m3],T[K],p[Pa],e[J/kg],c[m/s],s[J/kg/K]"
    for (i = 0; i < 40; i++)
        for (j = 0; j < 40; j++) {
            rho = 850 + 500 * i / 39; T = 275 * exp(j / 39 * log(700 / 275)); w = 1 / rho - 6.7212e-4
            P = 0.19 * 3610 * T / w
            printf "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", rho, T, P - 6217.8e5, (P + 0.19 * 6217.8e5) * w / 0.19 - 1177788,
                   sqrt(1.19 * P / w) / rho, 3610 * (1.19 * log(T) - 0.19 * log(P))
        }
}' >states.csv

count=0
for file in "$BULLA_BUILD"/lib/bulla/modules/*.so "$BULLA_BUILD"/tests/plugin/*.so "$BULLA_BUILD"/tests/skeleton/*.so; do
    case ${file##*/} in
        eos-table.so) judge 0 "$file" --set file=states.csv ;;
        inelastic-von-mises.so) judge 0 "$file" --set 'yield=300 MPa' --set 'hardening=500 MPa' --set exponent=0.3 ;;
        inelastic-power-law.so) judge 0 "$file" --set 'yield=300 MPa' --set reference-rate=1e5 --set sensitivity=0.1 ;;
        damage-tension.so) judge 0 "$file" --set 'stress=1 GPa' ;;
        damage-strain.so) judge 0 "$file" --set begins=0.3 ;;
        damage-energy.so) judge 0 "$file" --set 'begins=1 MJ/m3' ;;
        damage-tuler-butcher.so)
            judge 0 "$file" --set 'threshold=0.1 GPa' --set 'stress=1 GPa' --set 'duration=1 us' ;;
        *) judge 0 "$file" ;;
    esac
    grep -q '^pass: all [0-9]* checks hold' out || fail "$file: no verdict"
    grep -q 'ns per point' out || fail "$file: no cost"
    ! grep -v '^[a-z0-9-]*: table of \|^table: states.csv: ' err || fail "$file: something on stderr" # but what a law says of its tables
    count=$((count + 1))
done
[ $count -ge 16 ] || fail "only $count modules found"
judge 0 "$BULLA_BUILD"/lib/bulla/modules/limiter-*.so # several at once
[ "$(grep -c '^pass' out)" -ge 5 ] || fail "not all of them were checked"

# Refused as they stand, or (flawless, but no limiter at all) found wanting.
for file in "$BULLA_BUILD"/tests/hostile/*.so; do
    case ${file##*/} in none.so) continue ;; esac
    judge 2 "$file"
    [ ! -s out ] && [ "$(wc -l <err)" = 1 ] || fail "$file: not one line"
    grep -q "${file##*/}" err || fail "$file: is not named"
done
judge 1 "$BULLA_BUILD/tests/hostile/nan/nan_eos.so"
grep -q "well-posed in the stated range .* FAIL" out || fail "NaN is not found"
judge 1 "$BULLA_BUILD/tests/hostile/none.so"
grep -qE 'equal differences.* FAIL .* instead of ' out || fail "the worst value is not told"
grep -q '^FAIL: 1 of' out || fail "no verdict"
judge 2 nowhere.so
grep -q 'nowhere.so cannot be read' err || fail "a missing file"
printf 'text' >text.so
judge 2 text.so
head -c 9000 "$BULLA_BUILD/lib/bulla/modules/limiter-mc.so" >cut.so
judge 2 cut.so
grep -q 'truncated' err || fail "a truncated file"

# Trouble of the worse kinds, each in its own way.
for n in 1 2 3 4 5; do
    "${CC:-cc}" -shared -fPIC -fvisibility=hidden -DTROUBLE=$n -I"$BULLA_SOURCE/core/include" \
        "$BULLA_SOURCE/tests/plugin/trouble.c" -o trouble$n.so
done
judge 2 trouble1.so
grep -qE 'trouble1.so .*(signal 6|SIGABRT)' err || fail "abort while loading"
judge 1 trouble2.so
grep -qE 'trouble2.so (crashes \(slopes of pairs|ends the process)' err || fail "a crash" # the second with a sanitizer
judge 1 trouble3.so
grep -q 'trouble3.so ends the process (slopes of pairs.*never calls exit' err || fail "exit"
export BULLA_CHECK_SECONDS=1 # not ten
judge 1 trouble4.so
unset BULLA_CHECK_SECONDS
grep -q 'trouble4.so does not come back (slopes of pairs.* ended after 1 s' err || fail "a loop without end"
judge 1 trouble5.so
grep -q 'ends of parameter ranges.* FAIL .*amount = 2' out || fail "a refusal without a reason"

# Parameters without a default are asked for, and can be given.
cp "$BULLA_BUILD/lib/bulla/modules/eos-ideal-gas.so" own.so
judge 2 own.so # a copy of what is on the search path
judge 0 "$BULLA_BUILD/lib/bulla/modules/eos-ideal-gas.so" --set gamma=1.2
judge 2 "$BULLA_BUILD/lib/bulla/modules/eos-ideal-gas.so" --set cv=700
grep -q "parameter 'gamma' has no default" err || fail "a missing parameter"
judge 2 "$BULLA_BUILD/lib/bulla/modules/eos-ideal-gas.so" --set gama=1
code=0
"$BULLA" module chek x.so >out 2>err || code=$?
[ $code = 2 ] && grep -q 'bulla module check FILE.so' err || fail "a word that is unknown"
