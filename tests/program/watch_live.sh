# The page of `bulla watch` stays open while a run begins, works and is killed, and when the page's own program ends; it fits a
# phone; its script makes no mistakes.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
[ -x "$BULLA_BUILD/bin/bulla-watch" ] || { echo "skipped: built without libmicrohttpd"; exit 77; }
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    { echo "skipped: no chromium (Debian: chromium)"; exit 77; }

cat >tube.yaml <<'CASE'
bulla: 1
title: Two gases in a box
domain:
  lower: [0, 0]
  upper: [1 m, 1 m]
  cells: [32, 32]
  boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}
mesh: {tile: 16}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1 bar}
  - {box: {lower: [0, 0], upper: [0.5 m, 1 m]}, material: air, density: 1.4, pressure: 2 bar}
run: {until: 100 s}
output:
  directory: out
  snapshots: {every: 1 ms, fields: [pressure, density]}
  history: {every: 1 step, columns: {m: {mass: air}, p: {max: pressure}}}
CASE

mkfifo asks answers
exec 3<>asks 4<>answers # both ways: neither waits for the other end
start sh -c 'exec python3 -B "$BULLA_SOURCE/tests/browser.py" "$1" "$PWD/profile" <asks >answers' sh "$browser"
say() { # LINE...: to the browser; $answer
    echo "$*" >&3
    read -r answer <&4 || fail "the browser does not answer: $*"
}
comes() { say until "$@"; }

mkdir out
start "$BULLA" watch out >url 2>said
page=$run
await "the address" grep -q '/$' url
say width 360
say hurry 10 # it looks every 2 s, every 10 s when all is over
say open "$(cat url)"
comes "document.querySelector('#title').textContent === 'Nothing has run here yet'"
say value "window.stays = true"

start "$BULLA" run tube.yaml --quiet
tube=$run
comes "document.querySelector('#now .pill')?.textContent === 'running'"
comes "document.querySelector('#title').textContent === 'Two gases in a box'"
comes "document.querySelectorAll('#charts path').length === 2"
comes "document.querySelector('#images img')?.naturalWidth === 900"
say value "window.step = document.querySelector('#now').textContent"
comes "document.querySelector('#now').textContent !== window.step" # it goes on by itself
say value "document.documentElement.scrollWidth"
[ "$answer" = 360 ] || fail "wider than a phone: $answer"
say value "document.querySelector('#field').value = 'density'; document.querySelector('#field').dispatchEvent(new Event('change'))"
comes "document.querySelector('#images img').alt === 'density of out' && document.querySelector('#images img').complete"
say value "document.querySelector('#columns input').click(); document.querySelector('.chart button').click()"
comes "document.querySelector('.chart button').getAttribute('aria-pressed') === 'true'"

killed "$tube"
comes "document.querySelector('#now .pill').textContent === 'killed'"
comes "document.querySelector('#now .says').textContent.includes('its process is gone')"
comes "document.querySelector('#news').hidden"

kill -INT "$page"
ended "$page"
comes "!document.querySelector('#news').hidden && document.querySelector('#news').textContent.includes('does not answer')"
comes "document.querySelector('#now .pill').textContent === 'killed' && window.stays"
say faults
[ "$answer" = '[]' ] || fail "faults in the page: $answer"
say end
