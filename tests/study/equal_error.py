#!/usr/bin/env python3
"""The tables "equal error" in docs/cost.md: CPU time of MFC and ECOGEN over that of bulla where both have the same error.

    equal_error.py BULLA [DIR]          runs what is not yet in DIR (out/equal) and writes the tables
    equal_error.py BULLA DIR --print    the same to the standard output

Neither code is at hand here, so their row is put together of two halves. Error: their formulas, run in bulla (limiters,
reconstruction, Runge-Kutta steps; MUSCL with mc for all and two stages, WENO5 with three, MUSCL with van Leer). In the
tube H8, where their own figures are known (CALIBRATION), these have their errors within a tenth, which the first table
shows. Cost: nanoseconds per cell and stage (ECOGEN: per step) that were measured of them with one core of a Zen 4, times
the cells and stages of the run. bulla's cost is CPU time of its steps on the machine that runs this script."""
import csv
import json
import math
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "cost.md"

MUSCL = {"limiter": "mc", "interface-limiter": "mc"}
WENO5 = {"reconstruction": "{type: weno5-z, fractions: weno}", "limiter": "mc", "interface-limiter": "mc", "integrator": "ssprk3"}
VAN_LEER = {"limiter": "van-leer", "interface-limiter": "van-leer"}
PEERS = {  # name: scheme, ns per cell and `per` updates of a step, ns per cell and step, target
    "MFC MUSCL-MC RK2": (MUSCL, 2 * 385.0, 20),
    "MFC WENO5-M RK3": (WENO5, 3 * 1100.0, 40),
    "ECOGEN MUSCL van Leer": (VAN_LEER, 7000.0, 40),
}
OWN = {
    "koren + thinc": {"limiter": "koren", "interface-limiter": "thinc"},
    "koren + thinc 2": {"limiter": "koren", "interface-limiter": "{type: thinc, beta: 2}"},
    "koren + thinc + low-mach": {"limiter": "koren", "interface-limiter": "thinc", "low-mach": "0.05"},
    "koren + thinc 2 + hancock": {"limiter": "koren", "interface-limiter": "{type: thinc, beta: 2}", "integrator": "hancock"},
}
OWN_AXIS = {"limiter": "koren", "interface-limiter": "{type: thinc, beta: 2}", "low-mach": "0.05"}
CALIBRATION = [  # scheme, cells, until, L1(rho) and L1(u) that the code itself has
    ("MFC MUSCL-MC RK2", 500, "240 us", 2.296, 1.692),
    ("MFC MUSCL-MC RK2", 1000, "240 us", 1.313, 0.807),
    ("MFC WENO5-M RK3", 500, "240 us", 2.003, 1.614),
    ("MFC WENO5-M RK3", 1000, "240 us", 1.054, 0.744),
    ("ECOGEN MUSCL van Leer", 800, "241 us", 1.72, 0.907),
]
PEER_CELLS = [64, 128, 256]
OWN_MESHES = [(64, 0), (64, 1), (64, 2), (64, 3)]  # of level 0, levels
COLLAPSE = [  # code, cells per R0, CPU s, R_min/R0; ratio 20, axisymmetric, to R_min; 0.1950 is true
    ("MFC six-equation", 16, 51.0, 0.235),
    ("MFC six-equation", 24, 153.0, 0.2155),
]
TRUE = 0.1950
SPHERE = "{sphere: {center: [0, 0], radius: = %g * R0}}"
ROUGH = [f"{{region: {SPHERE % 4}, finest: 2}}", f"{{region: {SPHERE % 10}, finest: 1}}"]
NEAR = ["{interface: air%s}", f"{{region: {SPHERE % 1.2}%s}}"]
OWN_COLLAPSE = [  # cells per R0, levels above cells of R0, what is refined
    ("4", 2, [rule % "" for rule in NEAR]),
    ("8", 3, [rule % "" for rule in NEAR]),
    ("16", 4, [rule % "" for rule in NEAR]),
    ("16, 32 within 0.3 R0 after t_c", 5, [rule % ", finest: 4" for rule in NEAR] + [f"{{region: {SPHERE % 0.3}, from: = t_c}}"]),
]


def run(bulla, out, case, settings):
    """What a run left in provenance.json and expect.json, which is made where it is not there."""
    if not (out / "provenance.json").exists():
        command = [bulla, "run", ROOT / "cases" / "verify" / f"{case}.yaml", "--quiet", "--overwrite", "-o", out]
        for path, value in settings.items():
            command += ["--set", f"{path}={value}"]
        subprocess.run(command, stdout=subprocess.DEVNULL)  # bounds of the case are not those of these runs
    facts = json.loads((out / "provenance.json").read_text())
    expected = out / "expect.json"
    rows = json.loads(expected.read_text())["expectations"] if expected.exists() else []
    return facts, {row["what"]: row["value"] for row in rows}


def scheme(settings, cfl):
    return {f"scheme.{key}": value for key, value in settings.items()} | {"scheme.cfl": cfl}


def cpu(facts):
    return facts["cpu_s"] - facts["cpu_split_s"]["output"]


def off(out, reference, column):
    """L1 over time of a column against the reference, over its first value."""
    rows = [line.split(",") for line in reference.read_text().splitlines() if not line.startswith("#")]
    names = next(line for line in reference.read_text().splitlines() if line.startswith("# columns"))
    at = [name.strip().split("[")[0] for name in names.split(":")[1].split(",")].index(column)
    with (out / "history.csv").open() as file:
        history = [(float(row["t"]), float(row[column])) for row in csv.DictReader(file)]
    total, k = 0.0, 0
    for row in rows:
        t, true = float(row[0]), float(row[at])
        while k + 2 < len(history) and history[k + 1][0] < t:
            k += 1
        (t0, v0), (t1, v1) = history[k], history[k + 1]
        total += abs(v0 + (v1 - v0) * (t - t0) / (t1 - t0) - true)
    return total / len(rows)


def bubble(bulla, where, name, settings, cells, levels):
    """(error of area, error of density, CPU s of the steps, cell-steps) of SB2."""
    out = where / f"sb2-{name.replace(' ', '')}-{cells}-{levels}"
    facts, _ = run(bulla, out, "sb2", scheme(settings, 0.8) | {
        "domain.cells": f"[{cells}, {cells // 2}]", "mesh.levels": levels, "output.snapshots": "null"})
    reference = ROOT / "cases" / "verify" / "reference" / "sb2.csv"
    density = [off(out, reference, f"rho_{k}") / 1000.0 for k in range(1, 9)]
    return off(out, reference, "area"), sum(density) / len(density), cpu(facts), facts["leaves"] * facts["steps"]


def at_error(points, error):
    """Cost at an error, from a line through log error and log cost of the runs around it; None beyond them."""
    points = sorted(points)
    for (e0, c0), (e1, c1) in zip(points, points[1:]):
        if e0 <= error <= e1:
            part = (math.log(error) - math.log(e0)) / (math.log(e1) - math.log(e0))
            return math.exp(math.log(c0) + part * (math.log(c1) - math.log(c0)))
    return None


def calibration(bulla, where):
    yield "| H8, L1 of density and velocity | cells | of the code | of its formulas in bulla |"
    yield "| --- | ---: | --- | --- |"
    for name, cells, until, rho, u in CALIBRATION:
        out = where / f"h8-{name.replace(' ', '')}-{cells}"
        _, errors = run(bulla, out, "h8", scheme(PEERS[name][0], 0.4) | {"domain.cells": f"[{cells}]", "run.until": until})
        yield f"| {name} | {cells} | {rho:.3g}, {u:.3g} | {errors['L1(density)']:.3g}, {errors['L1(velocity_x)']:.3g} |"


def ratios(bulla, where):
    own = {name: [bubble(bulla, where, name, settings, *mesh) for mesh in OWN_MESHES] for name, settings in OWN.items()}
    yield "| SB2: code | cells | its CPU s | error of area | bulla s | ratio | error of density | bulla s | ratio | asked |"
    yield "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
    for name, (settings, cost, asked) in PEERS.items():
        for n in PEER_CELLS:
            area, density, _, steps = bubble(bulla, where, name, settings, n, 0)
            seconds = steps * cost * 1e-9
            row = [name, f"{n} x {n // 2}", f"{seconds:.3g}"]
            for column, error in enumerate((area, density)):
                found = [at_error([(run[column], run[2]) for run in runs], error) for runs in own.values()]
                best = min((cost for cost in found if cost), default=None)
                row += [f"{error:.3g}"] + ([f"{best:.3g}", f"{seconds / best:.0f}"] if best else ["", ""])
            yield "| " + " | ".join(row) + f" | {asked} |"
    yield ""
    yield "| SB2: bulla | cells | error of area | error of density | CPU s |"
    yield "| --- | --- | ---: | ---: | ---: |"
    for name, runs in own.items():
        for (cells, levels), (area, density, seconds, _) in zip(OWN_MESHES, runs):
            yield f"| {name} | {cells} x {cells // 2} + {levels} | {area:.3g} | {density:.3g} | {seconds:.3g} |"


def collapse(bulla, where):
    """The axisymmetric collapse of ratio 20, to 1.1 t_c."""
    rows = []
    for cells, levels, refine in OWN_COLLAPSE:
        out = where / f"axis-{cells.split(',')[0]}-{levels}"
        facts, errors = run(bulla, out, "a4-axisymmetric-20", scheme(OWN_AXIS, 0.8) | {
            "domain.cells": "[36, 36]", "mesh.levels": levels, "mesh.refine": f"[{', '.join(refine + ROUGH)}]",
            "run.until": "= 1.1 * t_c", "output.snapshots": "null"})
        rows.append((cells, cpu(facts), errors["least radius / R0"], errors["collapse time / t_c"]))
    yield "| collapse, ratio 20: code | cells per R0 | CPU s | least radius | off by | bulla s at that error | ratio | asked |"
    yield "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |"
    points = [(radius / TRUE - 1.0, seconds) for _, seconds, radius, _ in rows[:3]]
    for name, cells, seconds, radius in COLLAPSE:
        best = at_error(points, radius / TRUE - 1.0)
        ratio = f"{best:.2g} | {seconds / best:.0f}" if best else " | "
        yield f"| {name} | {cells} | {seconds:g} | {radius:g} | {100 * (radius / TRUE - 1):.1f} % | {ratio} | 100 |"
    for cells, seconds, radius, time in rows:
        yield f"| bulla | {cells} | {seconds:.2f} | {radius:.4f} at {time:.4f} t_c | {100 * (radius / TRUE - 1):.1f} % | | | |"


def main():
    bulla, where = sys.argv[1], pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "out/equal")
    where.mkdir(parents=True, exist_ok=True)
    tables = [list(calibration(bulla, where)), list(ratios(bulla, where)), list(collapse(bulla, where))]
    text = "<!-- equal -->\n" + "\n\n".join("\n".join(table) for table in tables) + "\n<!-- end equal -->"
    if "--print" in sys.argv:
        print(text)
    else:
        PAGE.write_text(re.sub(r"<!-- equal -->.*?<!-- end equal -->", lambda _: text, PAGE.read_text(), flags=re.S))


if __name__ == "__main__":
    main()
