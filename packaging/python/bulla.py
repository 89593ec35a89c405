"""Reads what bulla writes: runs, snapshots, cells, uniform arrays, histories, maps, sweeps.

One file, to be copied or put on PYTHONPATH; needs numpy, and h5py for snapshots and maps. pandas is used only by the
methods called frame(), matplotlib only by plot(). Everything is in SI units; volumes are whole ones, as in history.csv.
docs/python.md has recipes.

    import bulla
    run = bulla.Run("out/bubble-at-wall")
    run.history["V"].min(), run.history.units["V"]
    last = run[-1]
    pressure = last.uniform("pressure")        # [x, y], the finest cells
"""

import csv
import glob
import json
import os
import re

import numpy as np

GEOMETRIES = ("cartesian", "axisymmetric", "spherical")


class Table:
    """A table of numbers with names: history.csv, probes.csv. table["V"] is a column, table.units["V"] its unit."""

    def __init__(self, path, units=None):
        with open(path, newline="") as file:
            self.names = next(csv.reader(file))
            rows = [[float(x) for x in row] for row in csv.reader(file) if len(row) == len(self.names)]
        self.data = np.array(rows).reshape(len(rows), len(self.names))
        self.units = dict(units or {})

    def __getitem__(self, name):
        if name not in self.names:
            raise KeyError("no column %r; there are %s" % (name, ", ".join(self.names)))
        return self.data[:, self.names.index(name)]

    def __contains__(self, name):
        return name in self.names

    def __len__(self):
        return len(self.data)

    @property
    def t(self):
        return self["t"]

    def at(self, name, t):
        """A column at a time, straight lines between rows; nan outside."""
        return np.interp(t, self.t, self[name], left=np.nan, right=np.nan)

    def when(self, name, least=False):
        """The time of the largest (least) value of a column."""
        return self.t[(np.nanargmin if least else np.nanargmax)(self[name])]

    def frame(self):
        """As a pandas.DataFrame."""
        import pandas

        return pandas.DataFrame(self.data, columns=self.names)


def emitted(table, volume, distance, density, sound_speed, every=1):
    """Times [s] and pressures [Pa, above that at rest] of the sound of bubbles, `distance` [m] away in a liquid without walls:
    p(t + distance/c) = rho V''(t)/(4 pi distance), their volume V being a column of history.csv, over `every` rows to both
    sides. For bubbles that are small against the waves; of a bubble beside a wall that reflects, twice as much."""
    t, V, n = table.t, table[volume], int(every)
    if len(t) < 2 * n + 1:
        raise ValueError("%d rows are too few for a second difference over %d to both sides" % (len(t), n))
    before, here, after = (slice(k, k + len(t) - 2 * n) for k in (0, n, 2 * n))
    rise = (V[after] - V[here]) / (t[after] - t[here]) - (V[here] - V[before]) / (t[here] - t[before])
    curvature = 2 * rise / (t[after] - t[before])
    return t[here] + distance / sound_speed, density * curvature / (4 * np.pi * distance)


def _text(value):
    value = value if isinstance(value, bytes) or not hasattr(value, "shape") else value[()]
    return value.decode() if isinstance(value, bytes) else str(value)


def _check_parts(path, text):
    """With several writers the cells lie in parts beside a snapshot. HDF5 reads nothing where one is missing, and whatever
    there is where it is of another file: neither must go unseen."""
    for line in text.splitlines():
        name, size, seal = line.split()
        part = os.path.join(os.path.dirname(path), name)
        if not os.path.exists(part):
            raise FileNotFoundError("%s: its part %s is lost" % (path, name))
        with open(part, "rb") as file:
            head = file.read(4096)
        found = "%016x" % int.from_bytes(head[4088:4096], "little")
        if os.path.getsize(part) != int(size) or found != seal:
            raise ValueError("%s: its part %s is broken, or of another run or moment" % (path, name))


class Snapshot:
    """One file of fields/. snapshot["pressure"] is an array over the cells (leaves: the finest there are, which fill the
    domain without overlap), [n] or [n, 3]; "velocity_x" is a component. lower, upper, centre [n, dim] and volume [n] are
    those of the cells, level [n] too."""

    def __init__(self, path):
        import h5py

        self.path = path
        with h5py.File(path, "r") as file:
            if "VTKHDF" not in file or "bulla" not in file:
                raise ValueError("%s is no snapshot of bulla" % path)
            if "bulla/parts" in file:
                _check_parts(path, _text(file["bulla/parts"]))
            about = file["bulla"].attrs
            self.t = float(file.attrs["time"])
            self.step = int(file.attrs["iteration"])
            self.case, self.title, self.version = (_text(about[key]) for key in ("case", "title", "version"))
            self.materials = _text(about["materials"]).split(",")
            self.dim = int(about["dim"])
            self.geometry = GEOMETRIES[int(about["beta"])]
            self.domain = np.array([about["lower"], about["upper"]])[:, : self.dim]
            self.case_text = _text(file["bulla/case.yaml"])
            self.provenance = json.loads(_text(file["bulla/provenance.json"]))
            self.blocks = file["bulla/blocks"][()]
            fields = file["VTKHDF/CellData"]
            self.fields = list(fields)
            self.units = {name: _text(fields[name].attrs["units"]) for name in fields}
            corners = file["VTKHDF/Points"][()][file["VTKHDF/Connectivity"][()]].reshape(-1, 2**self.dim, 3)
        self.lower, self.upper = corners.min(1)[:, : self.dim], corners.max(1)[:, : self.dim]
        self.centre = 0.5 * (self.lower + self.upper)
        self._level()

    def _level(self):
        """Levels follow each other; a tile has n^dim cells, of which those under finer tiles are no leaves."""
        open_part = 1.0 - np.array([bin(c).count("1") for c in self.blocks[:, 5]]) / 2.0**self.dim
        cells = len(self.lower) / open_part.sum()
        self.tile = round(cells ** (1.0 / self.dim))
        levels = range(self.blocks[:, 0].max() + 1)
        counts = [round(cells * open_part[self.blocks[:, 0] == l].sum()) for l in levels]
        self.level = np.repeat(np.array(levels), counts)
        coarse = self.blocks[self.blocks[:, 0] == 0]
        self.cells = (coarse[:, 1 : 1 + self.dim].max(0) + 1) * self.tile  # of level 0, per axis

    def __getitem__(self, name):
        import h5py

        part = "xyz".find(name[-1]) if len(name) > 2 and name[-2] == "_" else -1
        with h5py.File(self.path, "r") as file:
            fields = file["VTKHDF/CellData"]
            if name in fields:
                return fields[name][()].astype(float)
            if part >= 0 and name[:-2] in fields and fields[name[:-2]].ndim > 1:
                return fields[name[:-2]][:, part].astype(float)
        raise KeyError("no field %r; there are %s" % (name, ", ".join(self.fields)))

    def __contains__(self, name):
        return name in self.fields

    def __len__(self):
        return len(self.lower)

    @property
    def volume(self):
        """Volumes of the cells: 2 pi r in axisymmetric scenes, whole shells in spherical ones, per metre in 2D, per square
        metre in 1D."""
        a, b = self.lower[:, 0], self.upper[:, 0]
        rest = np.prod((self.upper - self.lower)[:, 1:], axis=1)
        if self.geometry == "axisymmetric":
            return np.pi * (b * b - a * a) * rest
        if self.geometry == "spherical":
            return 4.0 / 3.0 * np.pi * (b**3 - a**3) * rest
        return (b - a) * rest

    def integral(self, field, where=None):
        """Sum of a field (a name, or values of the cells) times volume, over the cells in which `where` holds."""
        values = self[field] if isinstance(field, str) else np.asarray(field)
        weight = self.volume if where is None else self.volume * where
        return (values.T * weight).T.sum(0)

    def mean(self, field, where=None):
        """Mean of a field over the volume."""
        return self.integral(field, where) / self.integral(np.ones(len(self)), where)

    def spacing(self, level):
        """Sides of the cells of a level."""
        return (self.domain[1] - self.domain[0]) / (self.cells << level)

    def find(self, points):
        """Indices of the cells in which points [m, dim] lie; -1 outside."""
        points = np.atleast_2d(np.asarray(points, float)).reshape(-1, self.dim)
        found = np.full(len(points), -1)
        for level in range(self.level.max() + 1):
            cells = np.flatnonzero(self.level == level)
            width = self.spacing(level)
            shape = self.cells << level
            keys = np.ravel_multi_index(tuple(self._place(cells, level).T), shape)
            order = np.argsort(keys)
            inside = np.all((points >= self.domain[0]) & (points <= self.domain[1]), axis=1)
            at = np.clip(np.floor((points - self.domain[0]) / width).astype(int), 0, shape - 1)
            wanted = np.ravel_multi_index(tuple(at.T), shape)
            slot = np.minimum(np.searchsorted(keys[order], wanted), len(keys) - 1) if len(keys) else None
            if slot is None:
                continue
            hit = inside & (keys[order][slot] == wanted)
            found[hit] = cells[order][slot][hit]
        return found

    def sample(self, field, points):
        """Values of the cells in which points lie, nan outside."""
        values, at = self[field], self.find(points)
        out = values[at]
        out[at < 0] = np.nan
        return out

    def _place(self, cells, level):
        return np.rint((self.lower[cells] - self.domain[0]) / self.spacing(level)).astype(int)

    def uniform(self, field, level=None, within=None):
        """A field as an array [x, y, z] of cells of one level (the finest, if not given): coarser cells are repeated, finer
        ones averaged by volume. `within`: (lower, upper) corners; the array then covers what lies between them, and no
        other cell is touched. vectors: [x, y, z, 3]. axes() gives the coordinates."""
        values = self[field] if isinstance(field, str) else np.asarray(field, float)
        level = self.level.max() if level is None else level
        low, high = self._window(level, within)
        out = None
        for l in range(level + 1):
            a, b = low >> (level - l), -((-high) >> (level - l))
            if out is None:
                out = np.full(tuple(b - a) + values.shape[1:], np.nan)
            else:
                for axis in range(self.dim):
                    out = np.repeat(out, 2, axis=axis)
                shift = a - 2 * before
                out = out[tuple(slice(s, s + n) for s, n in zip(shift, b - a))].copy()
            before = a
            cells, at = self._cells_in(l, a, b)
            out[tuple((at - a).T)] = values[cells]
        self._average(values, level, low, high, out)
        return out

    def _window(self, level, within):
        shape = self.cells << level
        if within is None:
            return np.zeros(self.dim, int), shape
        corners = (np.asarray(within, float).reshape(2, self.dim) - self.domain[0]) / self.spacing(level)
        low = np.clip(np.floor(corners[0] + 1e-9).astype(int), 0, shape)
        high = np.clip(np.ceil(corners[1] - 1e-9).astype(int), 0, shape)
        if np.any(high <= low):
            raise ValueError("nothing of the domain lies within %s" % (within,))
        return low, high

    def _cells_in(self, level, low, high):
        cells = np.flatnonzero(self.level == level)
        at = self._place(cells, level)
        inside = np.all((at >= low) & (at < high), axis=1)
        return cells[inside], at[inside]

    def _average(self, values, level, low, high, out):
        """What lies on finer levels than that of the array."""
        fine = np.flatnonzero(self.level > level)
        if not len(fine):
            return
        at = np.floor((self.centre[fine] - self.domain[0]) / self.spacing(level)).astype(int)
        inside = np.all((at >= low) & (at < high), axis=1)
        fine, at = fine[inside], tuple((at[inside] - low).T)
        weight = np.zeros(out.shape[: self.dim])
        total = np.zeros(out.shape)
        np.add.at(weight, at, self.volume[fine])
        np.add.at(total, at, (values[fine].T * self.volume[fine]).T)
        covered = weight > 0.0
        out[covered] = (total[covered].T / weight[covered]).T

    def axes(self, level=None, within=None):
        """Coordinates of the centres of the cells of uniform(), one array per axis."""
        level = self.level.max() if level is None else level
        low, high = self._window(level, within)
        width = self.spacing(level)
        return [self.domain[0][d] + (np.arange(low[d], high[d]) + 0.5) * width[d] for d in range(self.dim)]

    def plot(self, field, axes=None, within=None, **options):
        """A picture of a field of a 2D scene (matplotlib); returns the axes."""
        import matplotlib.pyplot as pyplot

        if self.dim != 2:
            raise ValueError("a picture needs a scene with two axes")
        axes = axes or pyplot.gca()
        x, y = self.axes(within=within)
        image = axes.pcolormesh(x, y, self.uniform(field, within=within).T, **options)
        axes.set_aspect("equal")
        pyplot.colorbar(image, ax=axes, label="%s [%s]" % (field.replace("_", " "), self.units.get(field, "")))
        return axes

    def __repr__(self):
        return "<%s: t = %.9g s, %d cells, %s>" % (os.path.basename(self.path), self.t, len(self), ", ".join(self.fields))


class Map:
    """A space-time map: t [n], place [m] (coordinate `axis`), and map["pressure"] [n, m]. Of a rectangle place is (s1, s2),
    the distances along its sides, axis "s1,s2", map["pressure"] [n, m1, m2], and points() says where they are."""

    def __init__(self, path):
        import h5py

        self.path = path
        with h5py.File(path, "r") as file:
            names = [name for name in ("x", "y", "z", "s", "s1", "s2") if name in file]
            places = tuple(file[name][()] for name in names)
            self.axis, self.place = ",".join(names), places if len(places) > 1 else places[0]
            self.t = file["t"][()]
            self.fields = [name for name in file if name not in ["t"] + names]
            shape = tuple(len(place) for place in places)
            self._data = {name: file[name][()].reshape((-1,) + shape) for name in self.fields}
            self.units = {name: _text(file[name].attrs["units"]) for name in self.fields}
            self._sides = [file.attrs[name] for name in ("corner", "first", "second") if name in file.attrs]

    def points(self):
        """Of a rectangle: the places in space, [m1, m2, 3] m."""
        corner, first, second = self._sides
        s1, s2 = (s / np.linalg.norm(side) for s, side in zip(self.place, (first, second)))
        return corner + s1[:, None, None] * first + s2[None, :, None] * second

    def __getitem__(self, name):
        return self._data[name]


class Run:
    """The directory of a run. run[-1] is its last snapshot, run.at(t) the one next to a time, len(run) how many there
    are."""

    def __init__(self, directory):
        self.directory = directory
        if not os.path.isfile(os.path.join(directory, "case.yaml")):
            raise FileNotFoundError("%s is no directory of a run: it has no case.yaml" % directory)
        series = glob.glob(os.path.join(directory, "fields", "*.hdf.series"))
        self.files, self.times = [], np.zeros(0)
        if series:
            with open(series[0]) as file:
                files = json.load(file)["files"]
            self.files = [os.path.join(directory, "fields", entry["name"]) for entry in files]
            self.times = np.array([entry["time"] for entry in files])

    def _path(self, *names):
        return os.path.join(self.directory, *names)

    def _units(self, table):
        with open(self._path("columns.csv"), newline="") as file:
            return {row["column"]: row["unit"] for row in csv.DictReader(file) if row["file"] == table}

    def __len__(self):
        return len(self.files)

    def __getitem__(self, index):
        return Snapshot(self.files[index])

    def __iter__(self):
        return (Snapshot(path) for path in self.files)

    def at(self, t):
        """The snapshot whose time is nearest."""
        return self[int(np.argmin(np.abs(self.times - t)))]

    @property
    def history(self):
        return Table(self._path("history.csv"), self._units("history.csv"))

    @property
    def probes(self):
        return Table(self._path("probes.csv"), self._units("probes.csv"))

    @property
    def maps(self):
        """Names of the maps -> Map."""
        paths = sorted(glob.glob(self._path("maps", "*.hdf")))
        return {os.path.basename(path)[:-4]: Map(path) for path in paths}

    def _json(self, name):
        with open(self._path(name)) as file:
            return json.load(file)

    @property
    def provenance(self):
        """Version, commit, modules, time, memory, why the run ended."""
        return self._json("provenance.json")

    @property
    def expect(self):
        """The expectations of the case, as a list, each with what, value, bound, passed."""
        return self._json("expect.json")["expectations"]

    @property
    def case(self):
        """The resolved case as a dict (PyYAML)."""
        import yaml

        with open(self._path("case.yaml")) as file:
            return yaml.safe_load(file)


class Sweep:
    """The directory of a sweep: sweep["R0"] is a column of table.csv (numbers where all are, else texts), runs[i] the Run of
    row i, or None."""

    def __init__(self, directory):
        self.directory = directory
        with open(os.path.join(directory, "table.csv"), newline="") as file:
            rows = list(csv.reader(file))
        self.names, self.rows = rows[0], rows[1:]

    def __getitem__(self, name):
        if name not in self.names:
            raise KeyError("no column %r; there are %s" % (name, ", ".join(self.names)))
        column = [row[self.names.index(name)] for row in self.rows]
        try:
            return np.array([float(x) if x else np.nan for x in column])
        except ValueError:
            return np.array(column)

    def __len__(self):
        return len(self.rows)

    @property
    def runs(self):
        """The runs, row by row; None where there is no directory of one."""
        paths = [os.path.join(self.directory, name) for name in self["combination"]]
        return [Run(path) if os.path.isfile(os.path.join(path, "case.yaml")) else None for path in paths]

    def frame(self):
        """As a pandas.DataFrame."""
        import pandas

        return pandas.DataFrame({name: self[name] for name in self.names})


def scale(values, unit):
    """Values in a prefixed unit for people: scale(t, "us") of seconds, scale(p, "MPa") of pascals."""
    prefixes = {"n": 1e-9, "u": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6, "G": 1e9}
    match = re.fullmatch("([numkMG]?)(s|Pa|m|m/s|K|kg/m3)", unit)
    if not match:
        raise ValueError("%r is none of n, u, m, k, M, G before s, Pa, m, m/s, K, kg/m3" % unit)
    return np.asarray(values) / prefixes.get(match.group(1), 1.0)
