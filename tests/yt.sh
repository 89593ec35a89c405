#!/bin/sh
# yt.sh [PROGRAM] - packaging/python/bulla_yt.py against the history of the same step: the largest pressure, with its unit; the
# volume of a bubble in an axisymmetric scene; the area of a plane one. The same of files of three writers, whose cells are those
# of one; where a part is lost there is no number. Ends with 77 where there is no yt (Debian: python3-yt, which is what was
# tried). Nightly.
set -eu
program=${1:-$BULLA}
root=$(cd -- "$(dirname -- "$0")/.." && pwd)
/usr/bin/python3 -c 'import yt' 2>/dev/null || exit 77
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
ran() { # NAME CASE STEPS: on one rank, and on three that write
    "$program" run "$root/cases/$2.yaml" --variant quick --max-steps "$3" -o "$place/$1" --quiet
    "$program" run "$root/cases/$2.yaml" --variant quick --max-steps "$3" -o "$place/$1-of-three" --quiet -n 3 --writers 3
}
ran round tour/bubble-at-wall 20
ran plane verify/a3-levels-2d 5
PYTHONPATH="$root/packaging/python:${PYTHONPATH:-}" /usr/bin/python3 -B - "$place" <<'END'
import csv
import glob
import os
import sys

import bulla_yt
import numpy
import yt

yt.set_log_level(50)


def newest(run):
    return sorted(glob.glob(f"{sys.argv[1]}/{run}/fields/*.hdf"))[-1]


def last(run):
    with open(f"{sys.argv[1]}/{run}/history.csv", encoding="utf-8") as stream:
        row = list(csv.DictReader(stream))[-1]
    ds = bulla_yt.load(newest(run))
    return row, ds, ds.all_data()


def close(value, number, unit, tolerance=1e-6):
    value = value.to(unit)
    assert abs(float(value) / float(number) - 1) < tolerance, (value, number)


def same(run):
    one, three = last(run)[2], last(run + "-of-three")[2]
    for name in ("pressure", "density", "velocity_x"):
        a, b = one["bulla", name], three["bulla", name]
        assert a.size and a.units == b.units and numpy.array_equal(a.v, b.v), (run, name)


for run in ("round", "round-of-three"):
    row, ds, cells = last(run)
    close(cells.max(("bulla", "pressure")), row["p_max"], "Pa")
    close((cells["bulla", "alpha_air"] * cells["bulla", "whole_volume"]).sum(), row["V"], "m**3")
    close(ds.domain_right_edge[1], 5e-4, "m")
    close(cells.max(("bulla", "density")) * yt.YTQuantity(1, "m**3"), cells.max(("chombo", "density")).v, "kg")
for run in ("plane", "plane-of-three"):
    row, ds, cells = last(run)
    close(cells["bulla", "whole_volume"].sum(), float(ds.domain_width[0] * ds.domain_width[1]), "m**3")
    assert cells.max(("bulla", "velocity_x")).to("m/s") > 0
same("round")
same("plane")
for run in ("round-of-three", "plane-of-three"):
    assert len(glob.glob(newest(run) + ".a?")) == 3, run
os.remove(newest("round-of-three") + ".a2")
lost = numpy.isnan(last("round-of-three")[2]["bulla", "pressure"].v)
assert lost.any() and not lost.all()
END
echo "yt sees what the history says"
