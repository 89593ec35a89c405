# Cases that the program accepts are accepted by the schema too, judged by an independent reader.
set -eu
python3=/usr/bin/python3
"$python3" -c 'import yaml, jsonschema' 2>/dev/null || { echo "skipped: no python3-yaml or python3-jsonschema"; exit 77; }
cat >judge.py <<'END'
import glob, json, os, re, sys
import jsonschema, yaml


class Core(yaml.SafeLoader):
    """Plain scalars as in YAML 1.2: `no` is a text, 1e1 a number."""


Core.yaml_implicit_resolvers = {}
for tag, form, first in [
    ("null", r"^(~|null|Null|NULL|)$", ["~", "n", "N", ""]),
    ("bool", r"^(true|True|TRUE|false|False|FALSE)$", list("tTfF")),
    ("int", r"^[-+]?[0-9]+$", list("-+0123456789")),
    ("float", r"^[-+]?([.][0-9]+|[0-9]+([.][0-9]*)?)([eE][-+]?[0-9]+)?$", list("-+.0123456789")),
]:
    Core.add_implicit_resolver("tag:yaml.org,2002:" + tag, re.compile(form), first)

source = os.environ["BULLA_SOURCE"]
schema = json.load(open(source + "/schemas/case.schema.json"))
jsonschema.Draft7Validator.check_schema(schema)
judge = jsonschema.Draft7Validator(schema)
files = glob.glob(source + "/tests/data/case/good/*.yaml") + glob.glob(source + "/cases/*/*.yaml")
bad = 0
for name in sorted(files):
    for error in judge.iter_errors(yaml.load(open(name), Core)):
        print(name, list(error.absolute_path), error.message[:200])
        bad += 1
for name in ["key-unknown", "list-of-numbers", "choice-typo", "number-range", "boundary-other-pulse", "eos-unknown",
             "refine", "refine-lua", "column-two-measures"]:
    name = source + "/tests/data/case/bad/" + name + ".yaml"
    if judge.is_valid(yaml.load(open(name), Core)):
        print(name, "should be refused")
        bad += 1
assert len(files) > 10
sys.exit(bad > 0)
END
"$python3" judge.py
