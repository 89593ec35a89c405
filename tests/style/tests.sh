# Tests repeat: nothing in them is drawn from the machine or from its clock, none waits for a time, none ends processes by
# name. tests/lib.sh has what to use instead.
set -eu
cd "$BULLA_SOURCE"
scripts=$(find tests -name '*.sh' ! -path tests/style/tests.sh ! -path 'tests/perf/*' | sort)
[ "$(echo "$scripts" | wc -l)" -gt 50 ]
status=0
forbid() { # PATTERN INSTEAD FILES...
    pattern=$1 instead=$2
    shift 2
    if grep -nE -- "$pattern" "$@" /dev/null; then
        echo "^ $instead"
        status=1
    fi
}
# shellcheck disable=SC2086
forbid '/dev/u?random|[$][{]?(RANDOM|SRANDOM)|\bshuf\b|srand\(\)' "draw from the seed of the test: draw, noise" $scripts
nightly='tests/(repeat|whole|mutants/run)\.sh' # the day says which share a night takes; BULLA_NIGHT repeats it
# shellcheck disable=SC2046
forbid '\bdate [+-]|\b(EPOCH)?SECONDS\b|EPOCHREALTIME|systime\(|/proc/uptime' "judge no time on the clock" $(echo "$scripts" | grep -vxE "$nightly")
# shellcheck disable=SC2086
forbid '\b(pkill|killall|pgrep)\b' "start a session and end that: start, ended, killed" $scripts
waiting=$(echo "$scripts" | grep -vx 'tests/lib.sh')
# shellcheck disable=SC2086
forbid '^[^#]*\b(sleep|usleep)\b' "wait for what must happen, not for a time: await" $waiting
# shellcheck disable=SC2086
forbid '(^|[^&>])&( *#.*)?$' "start what runs in the background: start" $(echo "$waiting" | grep -vx 'tests/repeat.sh')
# shellcheck disable=SC2086
forbid '^[^#]*-newer ' "two files may be of the same instant: age them first" $waiting
exit $status
