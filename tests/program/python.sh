# packaging/python/bulla.py: the recipes of docs/python.md as they stand there, and their numbers against the program's own, in 1D, 2D
# with levels, axisymmetric, spherical and 3D scenes; wrong names and folders are refused; Octave reads a snapshot.
set -eu
python3=/usr/bin/python3
"$python3" -c 'import numpy, h5py' 2>/dev/null || {
    echo "skipped: no python3-numpy or python3-h5py"
    exit 77
}
export PYTHONPATH="$BULLA_SOURCE/packaging/python" PYTHONDONTWRITEBYTECODE=1
"$BULLA" run "$BULLA_SOURCE/tests/data/python/gallery.yaml" --quiet
"$BULLA" sweep "$BULLA_SOURCE/tests/data/python/gallery.yaml" --value 'min(V)/first(V)' --quiet >/dev/null

"$python3" - "$BULLA_SOURCE/docs/python.md" <<'END'
import importlib, re, sys
text = open(sys.argv[1]).read()
blocks = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
assert len(blocks) == 11, len(blocks)
names = {}
for number, block in enumerate(blocks, 1):
    needs = re.match(r"# needs (.*)\n", block)
    try:
        for module in needs.group(1).split(", ") if needs else []:
            importlib.import_module(module)
    except ImportError as error:
        print("recipe %d skipped: %s" % (number, error))
        continue
    exec(compile(block, "recipe %d" % number, "exec"), names)

# Against the program's numbers.
import numpy as np
last, run, history = names["last"], names["run"], names["run"].history
assert abs(last.mean("pressure") / history["mean"][-1] - 1) < 1e-6
assert abs(last.volume.sum() - 1e-6) < 1e-18 and last.level.max() == 1
assert abs(history.at("V", history.t[3]) - history["V"][3]) < 1e-30
fine, coarse = last.uniform("pressure"), last.uniform("pressure", level=0)
assert np.allclose(fine.reshape(32, 2, 32, 2).mean((1, 3)), coarse, rtol=1e-12) and not np.isnan(fine).any()
part = last.uniform("pressure", within=[(0.25e-3, 0.5e-3), (0.5e-3, 1e-3)])
assert np.array_equal(part, fine[16:32, 32:64])
x, y = last.axes()
points = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
assert np.array_equal(last.sample("pressure", points), fine.ravel())
assert np.isnan(last.sample("pressure", [[2e-3, 0]])).all()
assert np.allclose(last.uniform("velocity")[..., 0], last.uniform("velocity_x"))
own = np.abs(last.sample("pressure", last.centre) - last["pressure"])
assert own.max() == 0
assert (last.level == 1).sum() > 100 and (last.level == 0).sum() > 90
assert np.allclose((last.upper - last.lower)[last.level == 1], last.spacing(1))
sweep = names["sweep"]
assert list(sweep["parameters.p_s"]) == [5e6, 1e7] and [len(one) for one in sweep.runs] == [3, 3]
assert abs(sweep["min(V)/first(V)"][0] / (history["V"].min() / history["V"][0]) - 1) < 1e-12
for wrong in (lambda: last["presure"], lambda: history["W"], lambda: names["bulla"].Run("nothing"),
              lambda: last.uniform("pressure", within=[(2, 2), (3, 3)]), lambda: names["bulla"].scale(1, "furlong")):
    try:
        wrong()
    except (KeyError, FileNotFoundError, ValueError):
        continue
    sys.exit("a mistake went through")
END

# The sound of a bubble, from its volume, against probes in the liquid around it: amplitude and time.
"$BULLA" run "$BULLA_SOURCE/tests/data/python/ring.yaml" --quiet
"$python3" - <<'END'
import bulla, numpy as np
run = bulla.Run("out/ring")
for name, r in (("heard", 0.3e-3), ("far", 0.6e-3)):
    t, p = bulla.emitted(run.history, "V", r, 998.2, np.sqrt(4.4 * 6.001e8 / 998.2), every=8)
    heard = run.probes.at(name + ".pressure", t) - 1e5
    past = (t > 1.2e-6) & (t < 5.8e-6)
    assert np.sqrt(np.mean((p - heard)[past] ** 2) / np.mean(heard[past] ** 2)) < 0.01
    late = run.probes.at(name + ".pressure", t + 0.1e-6) - 1e5
    assert np.sqrt(np.mean((p - late)[past] ** 2) / np.mean(heard[past] ** 2)) > 0.1
try:
    bulla.emitted(run.history, "V", 1, 1e3, 1500, every=len(run.history))
    raise SystemExit("too few rows went through")
except ValueError:
    pass
END

# Volumes in every geometry.
cat >ball.yaml <<'END'
bulla: 1
title: A ball
domain: {geometry: spherical, lower: [0], upper: [1], cells: [64], boundaries: {x-: symmetry, x+: outflow}}
materials: {water: {eos: {type: stiffened-gas, preset: sg44}}, air: {eos: {type: ideal-gas, preset: air}}}
initial:
  - {everywhere: true, material: water, density: 998, pressure: 1 bar}
  - {sphere: {center: [0], radius: 0.31}, material: air, density: 1.2, pressure: 1 bar}
run: {until: 1 s, max-steps: 1}
output: {directory: out, snapshots: {every: 1 step, fields: [alpha_air], precision: double}, history: {columns: {V: {volume: air}}}}
END
geometry() { # NAME SETTINGS...
    name=$1
    shift
    "$BULLA" run ball.yaml -o "$name" --quiet "$@"
    "$python3" -c "import bulla; run = bulla.Run('$name'); off = run[-1].integral('alpha_air') / run.history['V'][-1] - 1; assert abs(off) < 1e-13, off; assert run[-1].uniform('alpha_air').ndim == run[-1].dim"
}
geometry spherical
geometry axisymmetric --set 'domain={geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [16, 16], boundaries: {x-: axis, x+: outflow, y-: outflow, y+: outflow}}' --set "initial=[{everywhere: true, material: water, density: 998, pressure: 1 bar}, {sphere: {center: [0, 0.5], radius: 0.31}, material: air, density: 1.2, pressure: 1 bar}]" --set 'mesh={levels: 1, tile: 8, refine: [{interface: air}]}'
geometry three --set 'domain={lower: [0, 0, 0], upper: [1, 1, 1], cells: [16, 16, 16], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow, z-: outflow, z+: outflow}}' --set "initial=[{everywhere: true, material: water, density: 998, pressure: 1 bar}, {sphere: {center: [0.5, 0.5, 0.5], radius: 0.31}, material: air, density: 1.2, pressure: 1 bar}]"
geometry one --set 'domain={lower: [0], upper: [1], cells: [32], boundaries: {x-: outflow, x+: outflow}}' --set "initial=[{everywhere: true, material: water, density: 998, pressure: 1 bar}, {box: {lower: [0.2], upper: [0.61]}, material: air, density: 1.2, pressure: 1 bar}]" --set 'mesh={levels: 2, refine: [{interface: air}]}'

# Octave.
command -v octave-cli >/dev/null || { echo "Octave's recipe was not tried: no octave-cli"; exit 0; }
sed -n '/^```octave$/,/^```$/{/^```/d;p}' "$BULLA_SOURCE/docs/python.md" >read.m
echo 'disp(sprintf("%.9g %d", mean_pressure, numel(p)));' >>read.m
octave-cli --no-init-file --quiet read.m >octave.txt 2>octave.err || { cat octave.txt octave.err; exit 1; }
"$python3" -c "
import bulla
first = bulla.Run('out/gallery')[0]
got = open('octave.txt').read().split()[-2:]
assert abs(float(got[0]) / first.mean('pressure') - 1) < 1e-6 and int(got[1]) == len(first), got"
