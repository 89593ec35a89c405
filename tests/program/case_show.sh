# What `show` prints is a case: it shows as itself, with parameters, units, defaults and overlays applied.
set -eu
folder=$BULLA_SOURCE/tests/data/case/good
"$BULLA" show "$folder/expressions.yaml" --set parameters.R0='2 mm' >once.yaml
"$BULLA" show once.yaml >twice.yaml 2>said.txt
cmp once.yaml twice.yaml
[ ! -s said.txt ]
grep -q 'upper: \[0.04\]' once.yaml
grep -q 'radius: 0.002' once.yaml
grep -q 'limiter: {type: mc}' once.yaml
grep -q 'p_f + R0 / math.max(r, R0)' once.yaml # varies in space: stays
! grep -q 't_c' once.yaml                      # used up
"$BULLA" check once.yaml >/dev/null

"$BULLA" schema >schema.json
cmp schema.json "$BULLA_SOURCE/schemas/case.schema.json" # bulla schema >schemas/case.schema.json
"$BULLA" schema --markdown >keys.md
cmp keys.md "$BULLA_SOURCE/docs/keys.md" # bulla schema --markdown >docs/keys.md
