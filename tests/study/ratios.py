#!/usr/bin/env python3
"""The table "ratios" in docs/decisions/low-mach.md: spherical collapses at ratios of 5 to 1000, with and without low-mach,
against the equation of Keller and Miksis.

    ratios.py BULLA [DIR]           runs what is not yet in DIR (out/ratios) and writes the table
    ratios.py BULLA DIR --print     to the standard output"""
import csv
import math
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "decisions" / "low-mach.md"

RATIOS = [5, 20, 100, 353, 1000]
CELLS = [10, 20, 41]  # per R0
SCHEMES = {
    "low-mach 1": {"low-mach": "1"},
    "low-mach 0.05": {"low-mach": "0.05"},
    "koren, thinc, low-mach 0.05": {"limiter": "koren", "interface-limiter": "thinc", "low-mach": "0.05"},
}
R0, P_B, RHO, GAMMA = 1e-3, 101325.0, 998.2, 1.4


def keller_miksis(ratio, until):
    """(t/t_c, R/R0) up to until t_c, and the time of the least radius; Runge-Kutta of fourth order with steps that follow
    the bubble. Water at the far pressure; gas on its isentrope."""
    far = ratio * P_B
    c, t_c = math.sqrt(4.4 * (far + 6e8) / RHO), 0.915 * R0 * math.sqrt(RHO / far)

    def rate(R, V):
        p = P_B * (R0 / R) ** (3.0 * GAMMA)
        push = (1.0 + V / c) * (p - far) / RHO - 3.0 * GAMMA * p * V / (RHO * c)  # R dp/dt = -3 gamma p V
        return V, (push - 1.5 * V * V * (1.0 - V / (3.0 * c))) / (R * (1.0 - V / c))

    t, R, V, path = 0.0, R0, 0.0, [(0.0, 1.0)]
    while t < until * t_c:
        dt = min(2e-4 * t_c, 2e-3 * R / (abs(V) + 1e-3))
        k1 = rate(R, V)
        k2 = rate(R + 0.5 * dt * k1[0], V + 0.5 * dt * k1[1])
        k3 = rate(R + 0.5 * dt * k2[0], V + 0.5 * dt * k2[1])
        k4 = rate(R + dt * k3[0], V + dt * k3[1])
        R += dt * (k1[0] + 2.0 * k2[0] + 2.0 * k3[0] + k4[0]) / 6.0
        V += dt * (k1[1] + 2.0 * k2[1] + 2.0 * k3[1] + k4[1]) / 6.0
        t += dt
        path.append((t / t_c, R / R0))
    return path, min(path, key=lambda point: point[1])[0], t_c


def run(bulla, out, ratio, cells, scheme):
    """[(t, R/R0)] of a run."""
    if not (out / "provenance.json").exists():
        far = 100 if ratio < 20 else 50  # radii: sound from the boundary arrives when the bubble has collapsed
        settings = {"parameters.ratio": ratio, "domain.upper": f"[= {far} * R0]", "domain.cells": f"[{2048 * cells // 41 * far // 50 // 16 * 16}]",
                    "run.until": "= 1.3 * t_c", "output.snapshots": "null"}
        settings |= {f"scheme.{key}": value for key, value in scheme.items()}
        command = [bulla, "run", ROOT / "cases" / "verify" / "a4-collapse-20.yaml", "--quiet", "--overwrite", "-o", out]
        for path, value in settings.items():
            command += ["--set", f"{path}={value}"]
        subprocess.run(command, stdout=subprocess.DEVNULL)  # bounds of the case are those of ratio 20
    with (out / "history.csv").open() as file:
        return [(float(row["t"]), float(row["R_over_R0"])) for row in csv.DictReader(file)]


def compare(history, path, t_c):
    """L1 of R/R0 up to R = 0.3 R0 of the equation, which holds so far at all ratios."""
    total = weight = 0.0
    k = 0
    least = next((i for i, point in enumerate(path) if point[1] < 0.3), min(range(len(path)), key=lambda i: path[i][1]))
    for (t0, _), (t1, R1) in zip(path[:least], path[1 : least + 1]):
        while k + 2 < len(history) and history[k + 1][0] < t1 * t_c:
            k += 1
        (a, u), (b, v) = history[k], history[k + 1]
        total += (t1 - t0) * abs(u + (v - u) * (t1 * t_c - a) / (b - a) - R1)
        weight += t1 - t0
    return total / weight


def lines(bulla, where):
    yield "| ratio (time of the equation) | | " + " | ".join(f"{cells} cells per R0" for cells in CELLS) + " |"
    yield "| ---: | --- |" + " --- |" * len(CELLS)
    for ratio in RATIOS:
        path, collapse, t_c = keller_miksis(ratio, 1.3)
        for name, scheme in SCHEMES.items():
            row = []
            for cells in CELLS:
                history = run(bulla, where / f"{ratio}-{cells}-{name.replace(', ', '-').replace(' ', '-')}", ratio, cells, scheme)
                late = min(history, key=lambda point: point[1])[0] / t_c
                row.append(f"{late:.4f}, {compare(history, path, t_c):.1e}")
            yield f"| {ratio} ({collapse:.4f}) | {name} | " + " | ".join(row) + " |"


def main():
    bulla, where = sys.argv[1], pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "out/ratios")
    where.mkdir(parents=True, exist_ok=True)
    text = "<!-- ratios -->\n" + "\n".join(lines(bulla, where)) + "\n<!-- end ratios -->"
    if "--print" in sys.argv:
        print(text)
    else:
        PAGE.write_text(re.sub(r"<!-- ratios -->.*?<!-- end ratios -->", lambda _: text, PAGE.read_text(), flags=re.S))


if __name__ == "__main__":
    main()
