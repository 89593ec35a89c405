"""pictures.py - a picture of each case for the gallery, from its quick variant.

What the picture shows is the end of the run (of spheres: how they got there). A picture is made again when the resolved
case has changed, and only then: the hash of that is in its name.
"""
import concurrent.futures
import hashlib
import os
import subprocess
import tempfile

import yaml

def show(program, case, variant):
    """The resolved case as text, or None if it cannot be read so."""
    done = subprocess.run([program, "show", case, *(["--variant", variant] if variant else [])], capture_output=True,
                          text=True, check=False)
    return done.stdout if done.returncode == 0 else None


def load(text):
    """What `show` writes, by libyaml's parser where PyYAML has it: a tenth of the time."""
    return yaml.load(text, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))


def subject(scene):
    """What the picture shows, as words for `bulla plot`: of a sphere its first column over time, else a field."""
    dim, solid = len(scene["domain"]["cells"]), any("constitutive" in m for m in scene["materials"].values())
    columns = list(scene["output"].get("history", {}).get("columns", {}))
    if scene["domain"]["geometry"] == "spherical" and columns:
        return ["history", columns[0]]
    if dim == 1:
        return ["density"]
    what = "von_mises" if solid else "velocity" if len(scene["materials"]) == 1 else "schlieren"
    return [what, "--mirror"] if scene["domain"]["geometry"] == "axisymmetric" else [what]


def draw(program, case, scene, path):
    """Runs the case and draws it; the reason if there is no picture."""
    words = subject(scene)
    field = "density" if words[0] == "history" else words[0]
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        snapshots = f"{{every: {scene['run']['until']} s, fields: [{field}], precision: double}}"
        run = subprocess.run(["nice", program, "run", case, "--variant", "quick", "-o", out, "--quiet", "--set",
                              "expect=null", "--set", f"output.snapshots={snapshots}"], capture_output=True, text=True,
                             check=False)
        if run.returncode != 0:
            return run.stderr.strip()
        plot = subprocess.run([program, "plot", out, *words, "-o", path, "--width", "560"], capture_output=True,
                              text=True, check=False)
        return plot.stderr.strip() if plot.returncode != 0 else None


def make(program, cases, folder):
    """Draws what is missing of {name: path of the case} into the folder: {name: file name}. Says what fails."""
    os.makedirs(folder, exist_ok=True)
    wanted, jobs = {}, {}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, case in cases.items():
            text = show(program, case, "quick")
            if text is None:
                continue
            scene = load(text)
            mark = hashlib.sha256((text + " ".join(subject(scene))).encode()).hexdigest()[:12]
            wanted[name] = f"{name.replace('/', '-')}-{mark}.png"
            path = os.path.join(folder, wanted[name])
            if not os.path.exists(path):
                jobs[name] = pool.submit(draw, program, case, scene, path)
        for name, job in jobs.items():
            if job.result():
                print(f"no picture of {name}: {job.result()}")
    for old in set(os.listdir(folder)) - set(wanted.values()):
        os.remove(os.path.join(folder, old))
    return {name: file for name, file in wanted.items() if os.path.exists(os.path.join(folder, file))}
