# The schema accepts and refuses the same cases as the program; what it cannot know is listed by name.
set -eu
python3=/usr/bin/python3
"$python3" -c 'import yaml, jsonschema' 2>/dev/null || {
    echo "skipped: no python3-yaml or python3-jsonschema; ./bulla setup installs them"
    exit 77
}
"$python3" "$BULLA_SOURCE/tests/editor/judge.py" "$BULLA" "$BULLA_SOURCE"

# A module on the path is in the schema and in the reference, with its own keys.
BULLA_MODULE_PATH=$BULLA_BUILD/tests/plugin:$BULLA_MODULE_PATH "$BULLA" schema >plugin.json
BULLA_MODULE_PATH=$BULLA_BUILD/tests/plugin:$BULLA_MODULE_PATH "$BULLA" schema --markdown >plugin.md
"$python3" - plugin.json <<'END_OF_CHECK'
import json, sys
import jsonschema

def without_words(schema, path=""):
    """Lists of allowed words that are empty: the language server of editors refuses a schema that has one."""
    found = [path] if isinstance(schema, dict) and schema.get("enum") == [] else []
    inside = schema.items() if isinstance(schema, dict) else enumerate(schema) if isinstance(schema, list) else ()
    return sum((without_words(value, f"{path}/{key}") for key, value in inside), found)


whole = json.load(open(sys.argv[1]))
assert not without_words(whole), without_words(whole)
jsonschema.Draft7Validator.check_schema(whole)
schema = jsonschema.Draft7Validator(whole)
case = json.loads("""{"bulla": 1,
  "domain": {"lower": [0], "upper": [1], "cells": [10], "boundaries": {"x-": "outflow", "x+": "outflow"}},
  "materials": {"water": {"eos": {"type": "tait-murnaghan", "sound-speed": "1.5 km/s"}}},
  "initial": [{"everywhere": true, "material": "water", "density": 998, "pressure": 1}], "run": {"until": 1}}""")
assert schema.is_valid(case)
case["materials"]["water"]["eos"]["sound-speed"] = "1.5 kg"
assert not schema.is_valid(case)
END_OF_CHECK
grep -q '^\*\*`type: tait-murnaghan`\*\*' plugin.md
