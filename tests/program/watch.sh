# `bulla watch`: who may see the page, what it says of runs that work, end, are killed and go on, of several, of hostile names;
# and that it touches nothing.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
[ -x "$BULLA_BUILD/bin/bulla-watch" ] || { echo "skipped: built without libmicrohttpd"; exit 77; }
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }

cat >tube.yaml <<'CASE'
bulla: 1
title: A <b>tube</b> & "more"
domain:
  lower: [0, 0]
  upper: [1 m, 1 m]
  cells: [32, 32]
  boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}
mesh: {tile: 16}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1 bar}
  - {box: {lower: [0, 0], upper: [0.5 m, 1 m]}, material: air, density: 1.4, pressure: 2 bar}
run: {until: 100 s}
output:
  directory: out
  snapshots: {every: 1 ms, fields: [pressure, density]}
  history: {every: 1 step, columns: {m: {mass: air}, p: {max: pressure}}}
  checkpoints: {every: 20 steps}
CASE

# ask.py METHOD ADDRESS [NAME: VALUE]: prints the status, the headers, an empty line and the answer.
# ask.py all ROOT STATUS METHOD PATH...: prints those of the paths that have another status.
cat >ask.py <<'PY'
import http.client, sys, urllib.parse
def ask(method, address, headers):
    address = urllib.parse.urlsplit(address)
    link = http.client.HTTPConnection(address.hostname, address.port, timeout=300)
    link.putrequest(method, address.path + ('?' + address.query if address.query else ''), skip_host='Host' in headers)
    for name, value in headers.items(): link.putheader(name, value)
    link.endheaders()
    return link.getresponse()
if sys.argv[1] == 'all':
    root, wanted, method, *paths = sys.argv[2:]
    for path in paths:
        answer = ask(method, root + path, {})
        if answer.status != int(wanted): print(answer.status, method, path)
else:
    answer = ask(sys.argv[1], sys.argv[2], dict(word.split(': ', 1) for word in sys.argv[3:]))
    sys.stdout.buffer.write(b'%d\n%s\n' % (answer.status, str(answer.headers).encode()) + answer.read())
PY
ask() { python3 ask.py "$@" >answer; }
status() { # WANTED METHOD ADDRESS...
    wanted=$1
    shift
    ask "$@"
    [ "$(head -n 1 answer)" = "$wanted" ] || fail "not $wanted: $*" answer
}
every() { # STATUS PATH...: all of them have it
    wanted=$1
    shift
    python3 ask.py all "$url" "$wanted" GET "$@" >answer
    [ ! -s answer ] || fail "not $wanted:" answer
}
# What the page is told: a line of Python over `run`, the first of them, and `runs`.
told() { # EXPRESSION [ADDRESS]
    ask GET "${2:-${url}state}"
    python3 - "$1" <<'PY'
import json, sys
text = open('answer', encoding='utf-8').read()
answer = json.loads(text[text.index('\n\n') + 2:])
runs = answer.get('runs', [answer])
run = runs[0] if runs else None
sys.exit(0 if eval(sys.argv[1]) else 1)
PY
}
holds() { told "$@" || fail "not so: $1" answer; }
serve() { # DIR...: sets $url, $page
    start "$BULLA" watch "$@" >url 2>said
    page=$run
    await "the address" grep -q '/$' url
    url=$(cat url)
}
leave() { # Ctrl-C ends it, with nothing wrong
    kill -INT "$page"
    ended "$page"
    [ "$code" = 0 ] || fail "exit code $code of the page" said
}

# --- a run that works, is killed, goes on and ends; the page is there all the time ---
mkdir out
serve out
holds 'runs == []'
case $url in http://127.0.0.1:*/????????????????????????????????/) ;; *) fail "no address" url ;; esac
start "$BULLA" run tube.yaml --quiet
tube=$run
await "a run at work" told 'runs and run["life"] == "running" and (run["t"] or 0) > 2e-3 and run["says"] == "The run is at work."'
holds 'run["title"] == "A <b>tube</b> & \"more\"" and run["until"] == 100 and 0 < run["percent"] < 100 and run["step"] > 0'
holds 'run["guard"] == {"fallback": 0, "relaxed": 0, "clipped": 0, "retries": 0} and run["ranks"] == 1'
await "a snapshot" told 'len(run["times"]) > 1 and run["fields"] == ["density", "pressure"]' "${url}run?run=0"
await "a checkpoint" sh -c 'ls out/checkpoints/*.chk >/dev/null 2>&1'
killed "$tube"
holds 'run["life"] == "killed" and "killed" in run["says"] and run["left_s"] is None and run["t"] > 2e-3'
find out -printf '%p %T@ %s\n' | sort >before
holds '[c["unit"] for c in run["columns"][:4]] == ["1", "s", "s", "kg/m"] and any("case" in l for l in run["log"])' "${url}run?run=0"
holds 'run["name"] == "m" and run["rows"] > 2 and run["t"][0] == 0 and abs(run["v"][0] - 1.3) < 1e-9 and len(run["t"]) == len(run["v"])' "${url}curve?run=0&column=3"
status 200 GET "${url}picture?run=0&snapshot=1&field=1"
grep -aq 'Content-Type: image/png' answer && grep -aq IEND answer || fail "no picture"
cp answer first
status 200 GET "${url}picture?run=0&snapshot=1&field=1" # the same once more, from memory
sed -i '/^Date/d' first answer
cmp first answer
status 200 GET "${url}picture?run=0&snapshot=0&field=1" # the start is one of two pressures, later there are more
sed -i '/^Date/d' answer
mv answer first
status 200 GET "${url}picture?run=0&snapshot=0&field=1&run1=0&snapshot1=2"
sed -i '/^Date/d' answer
! cmp -s first answer || fail "two snapshots do not share a scale"
first='picture?run=0&snapshot=0&field=1'
every 404 "$first&run1=7" "$first&run1=0" "$first&run1=0&snapshot1=999999" "$first&run1=0&snapshot1=x"
find out -printf '%p %T@ %s\n' | sort >after
cmp before after || fail "the page has touched the directory"
mv out/fields/tube_*.hdf . # what is not there, or is no snapshot, is no end of the page
status 500 GET "${url}picture?run=0&snapshot=1&field=1"
for file in tube_*.hdf; do head -c 3000 "$file" >"out/fields/$file"; done
ask GET "${url}picture?run=0&snapshot=1&field=1"
[ "$(head -n 1 answer)" != 200 ] || fail "a picture of a broken file"
mv tube_*.hdf out/fields

# --- who may see it ---
root=${url%????????????????????????????????/}
status 404 GET "$root"
status 404 GET "${root}state"
status 404 GET "${root}00000000000000000000000000000000/state"
status 404 GET "${root}00000000000000000000000000000000/"
status 200 GET "$url"
grep -q "Content-Security-Policy: default-src 'none';" answer && grep -q 'Referrer-Policy: no-referrer' answer
! grep -qE '(src|href|url\()="?(https?:|//)' answer || fail "something from elsewhere" answer
nonce=$(sed -n "s/.*script-src 'nonce-\([0-9a-f]*\)'.*/\1/p" answer)
[ "$(grep -c "<\(script\|style\) nonce=\"$nonce\">" answer)" = 2 ]
status 403 GET "${url}state" 'Host: evil.example'
status 403 GET "$url" "Host: 127.0.0.1.evil.example:80"
status 200 GET "${url}state" 'Host: localhost:1234' # the other end of a tunnel
for method in POST PUT DELETE HEAD OPTIONS PATCH; do status 405 "$method" "${url}state"; done
every 404 ../../etc/passwd %2e%2e/%2e%2e/etc/passwd case.yaml out/case.yaml .. // 'run?run=1' 'run?run=-1' 'run?run=' \
    'run?run=0x0' 'run?run=99999999999' run 'curve?run=0' 'curve?run=0&column=99' 'picture?run=0&snapshot=9999999&field=0' \
    'picture?run=0&snapshot=0&field=99' 'picture?run=../out&snapshot=0&field=0'
port=$(printf '%04X' "$(echo "$url" | cut -d: -f3 | cut -d/ -f1)")
awk -v port=":$port" 'FNR > 1 && $4 == "0A" && index($2, port) { print $2 }' /proc/net/tcp /proc/net/tcp6 >listens
[ "$(cat listens)" = "0100007F:$port" ] || fail "listens elsewhere" listens
ps -o args= -p "$page" >args
! grep -q "$(echo "$url" | cut -d/ -f4)" args || fail "the token is in the list of processes"

# --- goes on, and ends ---
"$BULLA" run tube.yaml --restart --quiet --set 'run.max-steps=60' || true
holds 'run["life"] == "finished" and run["reason"] == "finished at the step limit" and run["step"] > 60 and run["percent"] == 100'
"$BULLA" run tube.yaml --quiet --overwrite --set 'run.max-steps=4' --set 'expect=[{value: "last(m)", equals: 7, relative: 0.1}]' || true
holds 'run["life"] == "missed" and run["step"] == 4'
holds 'len(run["expect"]) == 1 and run["expect"][0]["passed"] is False' "${url}run?run=0"
"$BULLA" run tube.yaml --quiet --overwrite --walltime 0 || true
holds 'run["life"] == "stopped"'
rm -r out
holds 'run["life"] == "waiting"'
leave

# --- hostile names and files ---
mkdir -p many && cd many
newline=$(printf 'a\nb')
for name in '<img src=x onerror=alert(1)>' "$newline" 'q"u'"'"'o&te' "$(printf 'by\377te')" 'plain'; do
    mkdir "$name"
    printf 'title: "</script><img src=x onerror=alert(1)>"\nrun: {until: 1}\n' >"$name/case.yaml"
    printf 'step,t,<img src=x>\n0,0,1\n1,0.5,2\n' >"$name/history.csv"
    printf 'bulla\n\033[31m<b>\377\n' >"$name/log.txt"
done
printf '{"exit_code": 3, "exit_reason": "</p>\\u001b no", "hosts": 7}' >plain/provenance.json
printf '[1' >'q"u'"'"'o&te/provenance.json'
mkfifo 'q"u'"'"'o&te/expect.json'
mkdir empty
cd ..
serve many
holds 'len(runs) == 5 and sorted(r["name"] for r in runs) == ["<img src=x onerror=alert(1)>", "a?b", "by?te", "plain", "q\"u'"'"'o&te"]'
grep -q 'Content-Type: application/json' answer && grep -q 'nosniff' answer
holds 'all(r["title"].startswith("</script><img") and r["percent"] == 50 for r in runs)'
holds '[r["life"] for r in runs if r["name"] == "plain"] == ["failed"] and sum(r["life"] == "waiting" for r in runs) == 4'
for index in 0 1 2 3 4; do
    holds 'run["columns"][2]["name"] == "<img src=x>" and run["log"][1] == "?[31m<b>?"' "${url}run?run=$index"
    holds 'run["v"] == [1, 2]' "${url}curve?run=$index&column=2"
done
mkdir many/late && printf 'step,t\n' >many/late/history.csv
holds 'len(runs) == 6 and runs[5]["name"] == "late"'
port=$(echo "$url" | cut -d: -f3 | cut -d/ -f1)
code=0
"$BULLA" watch many --port "$port" >again 2>&1 || code=$?
[ "$code" = 3 ] && grep -q "cannot listen on 127.0.0.1:$port" again || fail "a port that is taken" again
leave

code=0
"$BULLA" watch nowhere 2>said || code=$?
[ "$code" = 2 ] && grep -q 'no directory nowhere' said
code=0
"$BULLA" watch many --port 70000 2>said || code=$?
[ "$code" = 2 ] && grep -q 'at most 65535' said

# --- without the program beside it ---
mkdir bare
cp "$BULLA" bare/bulla
code=0
BULLA_MODULE_PATH=$BULLA_MODULE_PATH bare/bulla watch many 2>said || code=$?
[ "$code" = 3 ] && grep -q 'libmicrohttpd-dev' said || fail "no word of the library" said
! ldd "$BULLA" | grep -qE 'microhttpd|cairo' || fail "the solver loads what draws or serves"
