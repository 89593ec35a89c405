# --json: every line of stdout is one object; the last one has the exit code; stderr is empty.
set -eu
cp "$BULLA_SOURCE/tests/data/cli/tube.yaml" .
code=0
"$BULLA" run tube.yaml -o out --overwrite --variant wrong --json >lines 2>said || code=$?
[ "$code" = 1 ]
[ ! -s said ] || { echo "stderr is not empty:"; cat said; exit 1; }
if grep -vnE '^\{"event":"(start|progress|end)",.*\}$' lines; then exit 1; fi
head -n 1 lines | grep -q '"event":"start","case":"tube","directory":".*out","until":0\.1,"cells":64,"ranks":1'
tail -n 1 lines | grep -qE '"event":"end","exit":1,"reason":"finished","t":0\.1,"step":[0-9]+'
