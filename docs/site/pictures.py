"""pictures.py - a picture of each case for the gallery, from its quick variant.

What the picture shows is the end of the run: in one dimension curves, else a field. A picture is made again when the
resolved case has changed, and only then: the hash of that is in its name.
"""
import concurrent.futures
import hashlib
import os
import subprocess
import tempfile

import yaml

FIELDS = ["schlieren", "von_mises", "pressure"]


def show(program, case, variant):
    """The resolved case as text, or None if it cannot be read so."""
    done = subprocess.run([program, "show", case, *(["--variant", variant] if variant else [])], capture_output=True,
                          text=True, check=False)
    return done.stdout if done.returncode == 0 else None


def field(scene):
    """What the picture shows."""
    if len(scene["domain"]["cells"]) == 1:
        return "density" if len(scene["materials"]) > 1 else "pressure"
    solid = any("constitutive" in material for material in scene["materials"].values())
    return "von_mises" if solid else "schlieren" if len(scene["domain"]["cells"]) == 2 else "pressure"


def draw(program, case, text, path):
    """Runs the case and draws it; the reason if there is no picture."""
    scene = yaml.safe_load(text)
    what = field(scene)
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        run = subprocess.run(
            ["nice", program, "run", case, "--variant", "quick", "-o", out, "--quiet", "--set", "expect=null", "--set",
             f"output.snapshots={{every: {scene['run']['until']} s, fields: [{what}]}}"],
            capture_output=True, text=True, check=False)
        if run.returncode != 0:
            return run.stderr.strip()
        options = ["--mirror"] if scene["domain"]["geometry"] == "axisymmetric" else []
        plot = subprocess.run([program, "plot", out, what, "-o", path, "--width", "560", *options], capture_output=True,
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
            wanted[name] = f"{name.replace('/', '-')}-{hashlib.sha256(text.encode()).hexdigest()[:12]}.png"
            path = os.path.join(folder, wanted[name])
            if not os.path.exists(path):
                jobs[name] = pool.submit(draw, program, case, text, path)
        for name, job in jobs.items():
            if job.result():
                print(f"no picture of {name}: {job.result()}")
    for old in set(os.listdir(folder)) - set(wanted.values()):
        os.remove(os.path.join(folder, old))
    return {name: file for name, file in wanted.items() if os.path.exists(os.path.join(folder, file))}
