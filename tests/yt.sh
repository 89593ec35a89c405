#!/bin/sh
# yt.sh [PROGRAM] - packaging/python/bulla_yt.py against the history of the same step: the largest pressure, with its unit; the
# volume of a bubble in an axisymmetric scene; the area of a plane one. Ends with 77 where there is no yt (Debian:
# python3-yt, which is what was tried). Nightly.
set -eu
program=${1:-$BULLA}
root=$(cd -- "$(dirname -- "$0")/.." && pwd)
/usr/bin/python3 -c 'import yt' 2>/dev/null || exit 77
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
"$program" run "$root/cases/tour/bubble-at-wall.yaml" --variant quick --max-steps 20 -o "$place/round" --quiet
"$program" run "$root/cases/verify/a3-levels-2d.yaml" --variant quick --max-steps 5 -o "$place/plane" --quiet
PYTHONPATH="$root/packaging/python" /usr/bin/python3 -B - "$place" <<'END'
import csv
import glob
import sys

import bulla_yt
import yt

yt.set_log_level(50)


def last(run):
    with open(f"{sys.argv[1]}/{run}/history.csv", encoding="utf-8") as stream:
        row = list(csv.DictReader(stream))[-1]
    ds = bulla_yt.load(sorted(glob.glob(f"{sys.argv[1]}/{run}/fields/*.hdf"))[-1])
    return row, ds, ds.all_data()


def close(value, number, unit, tolerance=1e-6):
    value = value.to(unit)
    assert abs(float(value) / float(number) - 1) < tolerance, (value, number)


row, ds, cells = last("round")
close(cells.max(("bulla", "pressure")), row["p_max"], "Pa")
close((cells["bulla", "alpha_air"] * cells["bulla", "whole_volume"]).sum(), row["V"], "m**3")
close(ds.domain_right_edge[1], 5e-4, "m")
close(cells.max(("bulla", "density")) * yt.YTQuantity(1, "m**3"), cells.max(("chombo", "density")).v, "kg")
row, ds, cells = last("plane")
close(cells["bulla", "whole_volume"].sum(), float(ds.domain_width[0] * ds.domain_width[1]), "m**3")
assert cells.max(("bulla", "velocity_x")).to("m/s") > 0
END
echo "yt sees what the history says"
