"""hunt.py SEED|FIRST..LAST ... - runs scenes of draw.py and looks for what must never be.

Each scene goes 16 steps, from seed 2000 on 48, on one rank, on three, and on two for half of them and then on one from
the checkpoint. Histories, probes, snapshots and checkpoints are the same to the bit; in a closed domain masses and
energy stay to round-off; no program crashes or hangs. A run may end by itself with a message (exit code 3, or at its
start): what is drawn can be too wild. Such seeds are named, and `-s` counts them as failures. With `-q` a scene goes
half its way on three ranks and the rest on one, without a run on three to the end. Prints what failed, and ends with 1.
"""
import csv
import glob
import json
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from draw import draw  # noqa: E402

BULLA, BUILD = os.environ["BULLA"], os.environ["BULLA_BUILD"]
DRIFT = 1e-12  # of a mass or the energy
HANGS = 1200  # s


def run(folder, *options):
    """Exit code, and the message of an error."""
    command = [BULLA, "run", "scene.yaml", "-o", "out", "--quiet", *options]
    try:
        end = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=HANGS, check=False)
    except subprocess.TimeoutExpired:
        return 124, "hangs"
    said = [line for line in end.stderr.splitlines() if "error: " in line]
    return end.returncode, said[0] if said else "no message"


def drifts(case, scene, folder):
    """Masses and the energy that do not stay."""
    with open(f"{folder}/out/history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    kept = {name: [name] for name in case["materials"]}
    for liquid, vapour in scene.pairs:
        kept[liquid].append(kept.pop(vapour)[0])
    for name, material in case["materials"].items():
        gas = material.get("damage", {}).get("opens")
        if gas:  # what opens a void takes its gas from the solid
            kept.setdefault(gas, []).extend(kept.pop(name))
    if not (scene.works or scene.tense):
        kept["E"] = ["E"]
    whole = case["output"]["history"].get("steps-of") != "finest"  # else coarser levels are ahead of finer ones in some rows
    for name, columns in kept.items() if scene.closed and whole else ():
        sums = [sum(float(row[column]) for column in columns) for row in rows]
        drift = max(abs(value / sums[0] - 1) for value in sums) if sums[0] else 0.0
        if not drift <= DRIFT:
            yield f"drift of {name} {drift:.1e}"


def notes_agree(said):
    """Of two checkpoints' notes one after the other: how often closures were iterated depends on where they began."""
    lines = [line for line in said.splitlines() if line and not line.startswith("counts.closures")]
    half = (len(lines) - 1) // 2
    return bool(lines) and lines[-1] == "/notes differs" and lines[:half] == lines[half:-1]


def differs(one, other, steps):
    """What is not the same of two runs that end after so many steps; None: nothing."""
    histories = [open(f"{folder}/out/history.csv", encoding="utf-8").read() for folder in (one, other)]
    if histories[0] != histories[1]:
        return "another history"
    for file in glob.glob("out/fields/*.hdf", root_dir=one) if other.endswith("three") else ():
        look = subprocess.run([f"{BUILD}/tests/test-unit-snapshot", f"{one}/{file}", f"{other}/{file}"], capture_output=True,
                              text=True, check=False)
        if look.returncode:
            return f"another {file}: {look.stderr.strip()[-60:]}"
    for name in ("probes.csv", "maps/cut.csv"):
        texts = [open(f"{folder}/out/{name}", encoding="utf-8").read() for folder in (one, other)
                 if os.path.exists(f"{folder}/out/{name}")]
        if len(texts) == 1 or texts[:1] != texts[1:]:
            return f"another {name}"
    last = [f"{folder}/out/checkpoints/scene_{steps:06}.chk" for folder in (one, other)]
    if all(os.path.exists(path) for path in last):
        look = subprocess.run([f"{BUILD}/tests/test-unit-checkpoint", *last], capture_output=True, text=True, check=False)
        if look.returncode and not notes_agree(look.stderr):
            return f"another checkpoint: {look.stderr.strip()[-60:]}"
    return None


def hunt(seed, quick):
    """Messages of a scene: what failed, and whether the run ended by itself."""
    case, scene = draw(seed)
    shutil.rmtree(str(seed), ignore_errors=True)
    places = {name: f"{seed}/{name}" for name in ("one", "three", "again")}
    for place in places.values():
        os.makedirs(place)
        with open(f"{place}/scene.yaml", "w", encoding="utf-8") as file:
            json.dump(case, file, indent=1)
    code, said = run(places["one"], "-n", "1")
    if code:
        ended = code == 3 or "the initial state is not admissible" in said
        return [] if ended else [f"exit code {code}: {said}"], said
    failed, steps = list(drifts(case, scene, places["one"])), case["run"]["max-steps"]
    half = ("-n", "3" if quick else "2", "--max-steps", str(steps // 2))
    others = {"three": [("-n", "3")], "again": [half, ("-n", "1", "--restart")]}
    for name in ("again",) if quick else others:
        parts = others[name]
        ends = [run(places[name], *options) for options in parts]
        bad = [f"{name}: exit code {code}: {said}" for code, said in ends if code]
        other = None if bad else differs(places["one"], places[name], steps)
        failed += bad + ([f"{name}: {other}"] if other else [])
    if not failed:
        shutil.rmtree(str(seed))
    return failed, None


def main(words):
    strict, quick = "-s" in words, "-q" in words
    seeds, ended, count = [], [], 0
    for word in words:
        first, _, last = word.partition("..")
        seeds += [] if word in ("-s", "-q") else range(int(first), int(last or first) + 1)
    for seed in seeds:
        failed, early = hunt(seed, quick)
        if early and not failed:
            ended.append(seed)
            print(f"scene {seed} ends by itself: {early}", flush=True)
        for message in failed:
            print(f"scene {seed} FAILS: {message}", flush=True)
        count += bool(failed)
    print(f"{len(seeds)} scenes, {count} failed, {len(ended)} ended by themselves")
    return 1 if count or (strict and ended) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
