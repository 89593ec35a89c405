"""judge.py - does the JSON Schema accept and refuse the same cases as the program?

    judge.py PROGRAM SOURCE

Three sets are judged by both: every case in tests/data/case and cases/; and one-line changes of a good case,
tests/data/case/overlays.txt. What the program refuses and the schema cannot know stands by name, with the reason, in
tests/data/case/unknowable.txt: that list must be exact. What the program accepts the schema always accepts.
"""
import glob
import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import jsonschema
import yaml

PROGRAM, SOURCE = sys.argv[1:]
DATA = os.path.join(SOURCE, "tests/data/case")


class Core(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):
    """YAML 1.2 as editors read it: `no` is a text, 1e1 a number, a key given twice an error."""

    def construct_mapping(self, node, deep=False):
        keys = [self.construct_object(key, deep=True) for key, _ in node.value]
        if len(keys) != len(set(map(str, keys))):
            raise yaml.YAMLError("a key is given twice")
        return super().construct_mapping(node, deep)


Core.yaml_implicit_resolvers = {}
for tag, form, first in [
    ("null", r"^(~|null|Null|NULL|)$", ["~", "n", "N", ""]),
    ("bool", r"^(true|True|TRUE|false|False|FALSE)$", list("tTfF")),
    ("int", r"^[-+]?[0-9]+$", list("-+0123456789")),
    ("float", r"^[-+]?([.][0-9]+|[0-9]+([.][0-9]*)?)([eE][-+]?[0-9]+)?$", list("-+.0123456789")),
]:
    Core.add_implicit_resolver("tag:yaml.org,2002:" + tag, re.compile(form), first)
Core.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(node.value))


class Verdicts:
    def __init__(self):
        with open(os.path.join(SOURCE, "schemas/case.schema.json"), encoding="utf-8") as file:
            schema = json.load(file)
        jsonschema.Draft7Validator.check_schema(schema)
        self.schema = jsonschema.Draft7Validator(schema)
        self.good = self.bad = self.wrong = 0
        self.unknowable = []

    def complain(self, name, what):
        print(f"{name}: {what}")
        self.wrong += 1

    def schema_says(self, text):
        """None if the text is fine, else the first complaint."""
        try:
            document = yaml.load(text, Core)
        except (yaml.YAMLError, UnicodeDecodeError) as error:
            return f"YAML: {error}"
        for error in self.schema.iter_errors(document):
            return f"{list(error.absolute_path)}: {error.message[:200]}"
        return None

    def judge(self, names, paths):
        """Yields what program and schema say of each file: is it good?"""
        def show(path):
            return subprocess.run([PROGRAM, "show", path], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

        with ThreadPoolExecutor(2) as pool:
            for name, path, run in zip(names, paths, pool.map(show, paths)):
                yield self.compare(name, path, run)

    def compare(self, name, path, run):
        with open(path, "rb") as file:
            said = self.schema_says(file.read())
        if run.returncode not in (0, 2):
            self.complain(name, f"the program ended with {run.returncode}")
        if run.returncode == 0:
            self.good += 1
            if said:
                self.complain(name, f"the program accepts it, the schema does not: {said}")
        else:
            self.bad += 1
            if not said:
                self.unknowable.append((name, run.stderr.decode(errors="replace").split("\n")[0]))
        return run.returncode == 0, said is None


def merge(base, overlay):
    """Lays a map over another: maps are merged, null deletes, all else replaces."""
    for key, value in overlay.items():
        if value is None:
            base.pop(key, None)
        elif isinstance(value, dict) and isinstance(base.get(key), dict):
            merge(base[key], value)
        else:
            base[key] = value


def judge_overlays(verdicts):
    """Lines '+ OVERLAY' (both accept), '- OVERLAY' (both refuse), '~ OVERLAY' (only the program refuses)."""
    with open(os.path.join(DATA, "good/minimal.yaml"), encoding="utf-8") as file:
        base = file.read()
    with open(os.path.join(DATA, "overlays.txt"), encoding="utf-8") as file:
        lines = [line.rstrip("\n") for line in file if line[:2] in ("+ ", "- ", "~ ")]
    paths = [f"overlay-{i}.yaml" for i in range(len(lines))]
    for line, path in zip(lines, paths):
        case = yaml.load(base, Core)
        merge(case, yaml.load(line[2:], Core))
        with open(path, "w", encoding="utf-8") as file:
            json.dump(case, file)
    wanted = {"+": (True, True), "-": (False, False), "~": (False, True)}
    before = len(verdicts.unknowable)
    for line, said in zip(lines, verdicts.judge(lines, paths)):
        if said != wanted[line[0]]:
            verdicts.complain(line, f"good to (program, schema): {said}")
    del verdicts.unknowable[before:]
    return len(lines)


def judge_files(verdicts):
    paths = glob.glob(f"{DATA}/good/*.yaml") + glob.glob(f"{DATA}/bad/*.yaml") + glob.glob(f"{SOURCE}/cases/*/*.yaml")
    for _ in verdicts.judge([os.path.relpath(path, SOURCE) for path in sorted(paths)], sorted(paths)):
        pass
    with open(os.path.join(DATA, "unknowable.txt"), encoding="utf-8") as file:
        listed = {line.split()[0] for line in file if line.strip() and not line.startswith("#")}
    found = {os.path.basename(name)[:-5]: said for name, said in verdicts.unknowable}
    for name in sorted(found.keys() - listed):
        verdicts.complain(name, f"only the program refuses it: {found[name]}")
    for name in sorted(listed - found.keys()):
        verdicts.complain(name, "unknowable.txt names it, but the schema refuses it too")
    return len(found)


if __name__ == "__main__":
    verdicts = Verdicts()
    unknowable = judge_files(verdicts)
    overlays = judge_overlays(verdicts)
    print(f"{verdicts.good} good and {verdicts.bad} bad cases, {overlays} of them overlays; "
          f"{unknowable} files only the program can refuse; {verdicts.wrong} wrong")
    assert verdicts.good >= 40 and verdicts.bad - unknowable >= 40
    sys.exit(verdicts.wrong > 0)
