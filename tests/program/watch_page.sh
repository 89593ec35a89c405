# The page of `bulla watch` in a browser: what it shows of runs, that names full of markup stay text, that it sees nothing without
# the token and asks nobody else for anything.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
[ -x "$BULLA_BUILD/bin/bulla-watch" ] || { echo "skipped: built without libmicrohttpd"; exit 77; }
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    { echo "skipped: no chromium (Debian: chromium)"; exit 77; }

seen() { # ADDRESS: the page after four seconds of its own time, in `page`; what the browser loads, in `net`
    limited "$browser" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir="$PWD/profile" \
        --no-first-run --disable-background-networking --host-resolver-rules='MAP * ~NOTFOUND, EXCLUDE 127.0.0.1' --virtual-time-budget=4000 --log-net-log="$PWD/net" \
        --dump-dom "$1" >page 2>browser || fail "the browser fails" browser
}
shows() { grep -qF -- "$1" page || fail "the page lacks: $1" page; }
lacks() { ! grep -qF -- "$1" page || fail "the page has: $1" page; }

evil='<img src=x onerror="document.title=1;document.body.dataset.evil=1">'
mkdir -p many
for name in one "two$evil"; do
    mkdir "many/$name"
    (cd "many/$name" && "$BULLA" run "$BULLA_SOURCE/cases/tour/tube.yaml" --variant quick -o . --quiet) || true
done
cd "many/two$evil"
sed -i "s|^title:.*|title: 'A </script><script>document.body.dataset.evil=2</script> title'|" case.yaml
sed -i '1s|step,t,dt,\([^,]*\)|step,t,dt,<b onclick=alert(1)>\&amp;|' history.csv
printf '</pre><script>document.body.dataset.evil=3</script>\n' >>log.txt
cat >expect.json <<'JSON'
{"expectations": [{"what": "<i>what</i>", "value": 1.5, "bound": "\"><s>", "passed": false}]}
JSON
cd ../..

start "$BULLA" watch many >url 2>said
await "the address" grep -q '/$' url
url=$(cat url)
seen "$url"
shows '<h1 id="title">2 runs</h1>'
shows 'finished'
shows '<path d="M'
shows 'src="picture?run=0&amp;snapshot='
shows '&lt;img src=x onerror="document.title=1;document.body.dataset.evil=1"&gt;'
shows '&lt;b onclick=alert(1)&gt;&amp;amp;'
shows '&lt;/pre&gt;&lt;script&gt;document.body.dataset.evil=3&lt;/script&gt;'
shows '&lt;i&gt;what&lt;/i&gt;'
lacks 'data-evil'
lacks '<img src="x"'
lacks '<i>what'
lacks '<b onclick'
lacks '<script>document'
grep -o 'src="picture?run=1&amp;[^"]*"' page | grep -q '&amp;run1=0&amp;snapshot1=' || fail "no scale in common" page
[ "$(grep -o '<img [^>]*>' page | grep -c 'alt="pressure')" = 2 ]

# All that the page has asked for is its own; what the browser itself looks for is no part of it.
grep '"network_isolation_key":"http://127.0.0.1' net | sed -n 's/.*"url":\("[^"]*"\).*/\1/p' | sort -u >asked
[ "$(wc -l <asked)" -gt 5 ] || fail "nothing was loaded?" asked
! grep -vE "^\"($url|data:)" asked || fail "asks somebody else"

seen "${url%????????????????????????????????/}"
shows 'not here'
lacks 'title">'
seen "${url%?/}x/"
shows 'not here'
kill -INT "$run"
ended "$run"

# One run is shown by its title, with what its expectations say.
start "$BULLA" watch "many/two$evil" >url 2>said
await "the address" grep -q '/$' url
seen "$(cat url)"
shows '<h1 id="title">A &lt;/script&gt;&lt;script&gt;document.body.dataset.evil=2&lt;/script&gt; title</h1>'
shows 'does not hold'
lacks 'data-evil'
kill -INT "$run"
ended "$run"
