"""bulla_yt.py - snapshots of bulla in yt, with units and true volumes.

    import bulla_yt
    ds = bulla_yt.load("out/bubble/fields/bubble_000100.hdf")
    ds.all_data().max(("bulla", "pressure"))              # 3.2e+07 Pa

yt by itself takes a metre for a centimetre, most fields for pure numbers, and axisymmetric scenes for plane ones. Here
lengths, times and masses are m, s, kg, and beside ("chombo", NAME) each field stands as ("bulla", NAME) with the unit that
the file gives it. ("bulla", "whole_volume") are whole volumes: 2 pi r included in axisymmetric scenes, per metre of depth
in plane ones.
"""
import h5py
import numpy
import yt

SI = {"length_unit": (1.0, "m"), "time_unit": (1.0, "s"), "mass_unit": (1.0, "kg")}


def _unit(text):
    """A unit as bulla writes it ("kg/m3", "J/kg", "1") in yt's words ("kg/m**3")."""
    if isinstance(text, bytes):
        text = text.decode()
    if text in ("", "1"):
        return "dimensionless"
    words = [word[:-1] + "**" + word[-1] if word[-1].isdigit() else word for word in text.split("/")]
    return "/".join(words)


def _facts(path):
    """Units of the fields by name, and beta: 1 in axisymmetric scenes."""
    with h5py.File(path, "r") as file:
        cells = file["VTKHDF/CellData"]
        units = {name: _unit(field.attrs.get("units", "")) for name, field in cells.items()}
        places = [file.attrs, file["bulla"].attrs]
        beta = next((int(numpy.ravel(attributes["beta"])[0]) for attributes in places if "beta" in attributes), 0)
    return units, beta


def _copy(name, unit):
    def made(field, data):  # names that yt asks for
        return data["chombo", name].v * yt.YTQuantity(1.0, unit)

    return made


def _volume(beta, dim):
    def made(field, data):  # names that yt asks for
        volume = data["index", "dx"] * data["index", "dy"]
        if dim == 3:
            return volume * data["index", "dz"]
        return volume * 2.0 * numpy.pi * data["index", "x"] if beta else volume * yt.YTQuantity(1.0, "m")

    return made


def load(path, **options):
    """A snapshot as a dataset of yt; options go to yt.load. Scenes in 2D and 3D."""
    units, beta = _facts(path)
    ds = yt.load(path, units_override=SI, unit_system="mks", **options)
    ds.fluid_types += ("bulla",)
    for kind, name in ds.field_list:
        stem = name[:-2] if name[-2:] in ("_x", "_y", "_z") and name not in units else name
        unit = units.get(name, units.get(stem, "dimensionless"))
        if kind == "chombo":
            ds.add_field(("bulla", name), function=_copy(name, unit), sampling_type="cell", units=unit)
    ds.add_field(("bulla", "whole_volume"), function=_volume(beta, ds.dimensionality), sampling_type="cell", units="m**3")
    return ds
