"""draw.py - scenes drawn at random: what no case of a person has, for hunt.py.

A seed gives a scene, always the same one: geometry, boundaries, levels, materials and their laws, what acts between
them, shapes painted over each other, and words of the scheme. Scenes are small and wild: pressures differ by tens,
shapes overlap, and matter meets at 100 m/s. What a case may not have together is not drawn.
"""
import random

from lively import liven

LIQUIDS = [
    {"type": "stiffened-gas", "gamma": 4.4, "p-inf": "600 MPa", "cv": 590},
    {"type": "stiffened-gas", "gamma": 2.35, "p-inf": "1 GPa", "cv": 1816},
    {"type": "nasg", "preset": "water-2016"},
    {"type": "mnasg", "preset": "water"},
]
GASES = [{"type": "ideal-gas", "gamma": 1.4, "cv": 717.5}, {"type": "ideal-gas", "gamma": 1.67, "cv": 3115}]
SHEAR = {"gel": "50 kPa", "stone": "5 GPa"}


class Dice:
    """Only random() is the same in all versions of Python."""

    def __init__(self, seed):
        self.random = random.Random(seed).random

    def coin(self, chance=0.5):
        return self.random() < chance

    def number(self, low, high):
        return float(f"{low + (high - low) * self.random():.3g}")

    def power(self, low, high):
        return 10.0 ** self.number(low, high)

    def pick(self, *things):
        return things[int(self.random() * len(things))]

    def shuffled(self, things):
        left, out = list(things), []
        while left:
            out.append(left.pop(int(self.random() * len(left))))
        return out


class Scene:
    """A case under way, and what is known of it: `closed`, nothing leaves; `works`, something does work on it."""

    def __init__(self, seed):
        self.dice = Dice(seed)
        self.case = {"bulla": 1, "title": f"Scene {seed}"}
        self.fluids, self.solids, self.pairs = [], [], []
        self.viscous, self.conducts, self.tense, self.works, self.bodies = False, False, False, False, False


def domain(scene):
    dice = scene.dice
    scene.kind = dice.pick("line", "ball", "plane", "plane", "plane", "plane", "axis", "axis", "axis", "space", "space")
    scene.dim = {"line": 1, "ball": 1, "plane": 2, "axis": 2, "space": 3}[scene.kind]
    scene.length, scene.closed = dice.power(-5, -2), dice.coin(0.85)
    scene.curved = scene.kind in ("ball", "axis")
    ends = {}
    for d in range(scene.dim):
        a = "xyz"[d]
        rigid = ("reflecting", "symmetry")
        if scene.curved and d == 0:
            ends["x-"], ends["x+"] = "axis", dice.pick(*rigid) if scene.closed else "outflow"
        elif dice.coin(0.4):
            ends[a + "-"] = ends[a + "+"] = "periodic"
        else:
            ends[a + "-"], ends[a + "+"] = dice.pick(*rigid), dice.pick(*rigid) if scene.closed else "outflow"
    scene.case["domain"] = {"lower": [0.0] * scene.dim, "upper": [scene.length] * scene.dim,
                            "cells": [{1: 64, 2: 32, 3: 16}[scene.dim]] * scene.dim, "boundaries": ends}
    if scene.curved:
        scene.case["domain"]["geometry"] = {"ball": "spherical", "axis": "axisymmetric"}[scene.kind]


def fluids(scene, materials):
    dice = scene.dice
    boils = dice.coin(0.2)
    if dice.coin(0.9) or boils:
        materials["water"] = {"eos": {"type": "nasg", "preset": "water-2016"} if boils else dice.pick(*LIQUIDS)}
    if dice.coin(0.8) or not materials:
        materials["air"] = {"eos": dice.pick(*GASES)}
    if dice.coin(0.2):
        materials["oil"] = {"eos": {"type": "stiffened-gas", "gamma": 3.0, "p-inf": "500 MPa", "cv": 800}}
    if boils:
        materials["steam"] = {"eos": {"type": "ideal-gas", "preset": "water-2016"}}
        scene.pairs.append(("water", "steam"))
    scene.fluids = list(materials)


def solids(scene, materials):
    dice = scene.dice
    for name, shear in SHEAR.items():
        if not dice.coin(0.25):
            continue
        stiff = name == "stone"
        law = {"type": "neo-hookean" if stiff else dice.pick("neo-hookean", "fung", "gent"), "shear-modulus": shear,
               "reference-density": 2000 if stiff else 1000}
        if law["type"] == "gent":
            law["limit"] = 10
        rest = {"p-inf": "5 GPa", "cv": 2451} if stiff else {"p-inf": "600 MPa", "cv": 588}
        solid = {"eos": dict({"type": "stiffened-gas", "gamma": 4.4}, **rest), "constitutive": law}
        if dice.coin(0.3):
            solid["viscoelastic"] = [{"shear-modulus": shear, "relaxation-time": scene.length / 1500}]
        elif stiff and dice.coin(0.4):
            solid["plastic"] = {"type": "von-mises", "yield": "20 MPa", "hardening": dice.pick(0.0, 1e8)}
        if dice.coin(0.15):
            solid["damage"] = {"type": "tension", "stress": "1 MPa"}
        materials[name] = solid
        scene.solids.append(name)


def transport(scene, materials):
    dice = scene.dice
    thin = {"air": (1.8e-5, 0.026), "steam": (1.2e-5, 0.03)}
    viscous, conducts = dice.coin(0.4), dice.coin(0.35)
    for name, material in materials.items():
        mu, k = thin.get(name, (dice.power(-3, 0), 0.6))
        if viscous and dice.coin(0.75):
            material["viscosity"] = f"{mu:.3g} Pa s"
            scene.viscous = True
        if conducts and dice.coin(0.85):
            material["conductivity"] = f"{k} W/m/K"
            scene.conducts = True
        if dice.coin(0.03):
            material["drag"] = 1e5


def exchange(scene):
    """What acts between materials, and on all."""
    dice, case = scene.dice, scene.case
    if scene.pairs:
        pair = {"liquid": "water", "vapour": "steam"}
        if "air" in scene.fluids and dice.coin(0.7):
            pair["gases"] = ["air"]
        if dice.coin(0.3):
            pair["rate"] = {"type": "relaxation", "time": scene.length / 1000}
        if dice.coin(0.3):
            pair["where"], pair["nucleation"] = "everywhere", {"tension": "1 MPa"}
        case["phase-change"] = [pair]
        if "gases" in pair and dice.coin(0.4):
            case["gas-diffusion"] = [{"gases": ["steam", "air"], "diffusivity": "25 mm2/s"}]
    elif len(scene.fluids) > 1 and scene.kind != "line" and dice.coin(0.3):
        case["surface-tension"] = {"+".join(scene.fluids[:2]): "72.8 mN/m"}
        scene.tense = True
    if dice.coin(0.1) and scene.kind != "ball":
        case["sources"] = {"acceleration": [0.0] * (scene.dim - 1) + [-1e4]}
        scene.works = True
    busy = scene.solids or scene.conducts or scene.viscous or scene.tense or scene.pairs
    if scene.dim > 1 and not busy and dice.coin(0.2):
        at = [0.5 * scene.length] * scene.dim
        case["bodies"] = {"rock": {"sphere": {"center": at, "radius": 0.15 * scene.length}}}
        scene.bodies = True


def shape(scene):
    dice, L = scene.dice, scene.length
    if scene.kind == "ball":
        return {"sphere": {"center": [0.0], "radius": dice.number(0.2 * L, 0.6 * L)}}
    at = [dice.number(0.2 * L, 0.8 * L) for _ in range(scene.dim)]
    if scene.curved and dice.coin(0.7):
        at[0] = 0.0
    if dice.coin(0.75):
        return {"sphere": {"center": at, "radius": dice.number(0.12 * L, 0.35 * L)}}
    if scene.dim > 1 and dice.coin():
        return {"half-space": {"point": at, "normal": [dice.number(0.1, 1.0) for _ in at]}}
    return {"box": {"lower": [dice.number(0.0, 0.5 * L) for _ in at], "upper": [dice.number(0.6 * L, L) for _ in at]}}


def initial(scene, materials):
    dice = scene.dice
    order = dice.shuffled(materials)
    p, T, fastest = dice.power(4.5, 7), 380 if scene.pairs else 300, dice.pick(0.0, 1.0, 30.0, 100.0)

    def layer(place, material, pressure):
        u = [0.0 if scene.curved and d == 0 else dice.number(-fastest, fastest) for d in range(scene.dim)]
        return dict(place, material=material, temperature=T, pressure=pressure, velocity=u)

    layers = [layer({"everywhere": True}, order[0], p)]
    for name in order[1:]:
        for _ in range(dice.pick(1, 1, 2)):
            layers.append(layer(shape(scene), name, p * dice.pick(1, 1, 1, 0.5, 3, 10)))
            if dice.coin(0.15) and len(scene.fluids) > 1:
                one, other = dice.shuffled(scene.fluids)[:2]
                part = round(dice.number(0.01, 0.99), 3)
                del layers[-1]["material"]
                layers[-1]["fractions"] = {one: part, other: round(1 - part, 3)}
    scene.case["initial"] = layers
    return order


def mesh(scene, order):
    dice = scene.dice
    mesh = {"tile": 8, "levels": dice.pick(0, 1, 1, 2) if scene.dim < 3 else dice.pick(0, 1)}
    if mesh["levels"]:
        mesh["refine"] = [{"jump": "pressure", "above": 0.1}]
        if len(order) > 1:
            mesh["refine"].append({"interface": dice.pick(*order)})
        mesh["regrid-every"] = dice.pick(2, 3, 4)
        mesh["subcycle"] = dice.coin(0.8)
    scene.case["mesh"] = mesh


def scheme(scene):
    dice = scene.dice
    fluid, plain = not scene.solids, not (scene.conducts or scene.pairs)
    words = {
        "riemann": (0.3, ("hll", "hllc", "hlld") if fluid else ("hlld", "hll")),
        "limiter": (0.3, ("koren", "minmod", "van-albada", "mc", "superbee")),
        "interface-limiter": (0.3, ("superbee", "minmod", "koren") + (("thinc",) if fluid else ())),
        "closure": (0.25 if plain else 0.0, ("allaire",)),
        "low-mach": (0.3, (0.05, 0.3, 1)),
        "reconstruction": (0.15, ("weno5-z",)),
        "traction": (0.2 if scene.solids and not scene.pairs else 0.0, ("common", "pressure")),
        "shock-fronts": (0.15, ("calm",)),
        "exchange": (0.2, ("fast", "full")),
        "cfl": (0.2, (0.3, 0.5)),
    }
    chosen = {word: dice.pick(*values) for word, (chance, values) in words.items() if dice.coin(chance)}
    flows = scene.viscous or scene.conducts or any("drag" in m for m in scene.case["materials"].values())
    if dice.coin(0.2):
        plain = not (scene.solids or flows or scene.pairs or scene.tense or scene.bodies or "closure" in chosen)
        chosen["integrator"] = "hancock" if plain else "ssprk3"
    elif (scene.viscous or scene.conducts) and not scene.pairs and dice.coin():
        chosen["diffusion"] = "rkl2"
    if chosen:
        scene.case["scheme"] = chosen


# What seeds from WIDE on have as well: laws from tables, voids, liquids that thin in shear, walls that move or are hot, bodies
# that move, meshes of odd sizes, and words of a phase change. After all else, so that lower seeds give what they always gave.
WIDE = 1000
LIVELY = 2000  # from here on: lively.py
SURFACES = 3300  # from here on: solids that meet fluids in all ways that the scheme knows
SLANTS = 3600  # from here on: interface limiters along normals and along axes
LIMITED = 3761  # normals more often, and limiters of their own along surfaces
WAVES = 4201  # from here on: waves come in through open faces
SWIRLS = 4871  # from here on: what turns around the axis
OTHER_LIQUIDS = [{"type": "tait", "preset": "water"}, {"type": "modified-tait", "preset": "refit"},
                 {"type": "iapws95", "preset": "water", "table-size": 64}, {"type": "stiffened-gas", "preset": "glycerol"}]
OTHER_GASES = [{"type": "helmholtz-air", "preset": "air", "table-size": 64}, {"type": "rkpr", "preset": "air"},
               {"type": "peng-robinson", "preset": "air", "eval": "table"}, {"type": "ideal-gas", "preset": "sf6"}]
OTHER_SOLIDS = [{"type": "mooney-rivlin", "ratio": 0.3}, {"type": "quadratic"}, {"type": "fung", "stiffening": 3}]
BREAKS = [{"type": "strain", "begins": 0.01}, {"type": "stretch", "begins": 1.02, "ends": 1.1},
          {"type": "energy", "begins": 100}, {"type": "tension", "stress": "1 MPa", "of": "principal"}]
THIN = [{"type": "carreau", "preset": "blood"}, {"type": "herschel-bulkley", "preset": "gel"},
        {"type": "power", "preset": "blood"}, {"type": "casson", "preset": "blood"}]


def wide_matter(scene):
    dice = scene.dice
    for name, material in scene.case["materials"].items():
        if name in scene.fluids:
            if not scene.pairs and dice.coin(0.35):
                material["eos"] = dice.pick(*(OTHER_GASES if name == "air" else OTHER_LIQUIDS))
            if "viscosity" in material and name != "air" and dice.coin(0.4):
                material["viscosity"] = dice.pick(*THIN)
            continue
        law = material["constitutive"]
        if dice.coin(0.3) and "plastic" not in material and "viscoelastic" not in material:
            kept = {key: law[key] for key in ("shear-modulus", "reference-density")}
            material["constitutive"] = dict(kept, **dice.pick(*OTHER_SOLIDS))
        if dice.coin(0.3):
            material["damage"] = dict(dice.pick(*BREAKS[0 if material.get("plastic", {}).get("hardening") else 1:]))
        if "damage" in material and "air" in scene.fluids and dice.coin(0.6):
            material["damage"]["opens"] = "air"


def wide_walls(scene):
    dice, ends = scene.dice, scene.case["domain"]["boundaries"]
    for side, end in ends.items():
        if end != "reflecting" or not dice.coin(0.4):
            continue
        wall = {"type": "no-slip" if scene.viscous else "reflecting"}
        if scene.viscous and not scene.curved and dice.coin(0.4):
            wall["velocity"] = [0.0 if d == "xyz".index(side[0]) else 10.0 for d in range(scene.dim)]
            scene.works = True
        if scene.conducts and dice.coin(0.5):
            wall.update(dice.pick({"temperature": 350}, {"heat-flux": 1e6}))
            scene.works = True
        if scene.tense and scene.viscous and dice.coin(0.5):
            wall["contact-angle"] = {next(iter(scene.case["surface-tension"])): f"{dice.pick(60, 120)} deg"}
        ends[side] = wall
    if not scene.closed and dice.coin(0.3):
        for side, end in ends.items():
            ends[side] = "non-reflecting" if end == "outflow" else end


def wide_forces(scene):
    dice, case = scene.dice, scene.case
    if scene.bodies and dice.coin(0.6):
        turns = scene.kind == "plane" and dice.coin(0.3)
        L = scene.length
        swing = f"= {0.1 * L}*math.sin({500 / L}*t)"
        case["bodies"]["rock"]["displacement"] = ["= 0" if scene.curved and d == 0 else swing for d in range(scene.dim)]
        if turns:
            del case["bodies"]["rock"]["displacement"]
            case["bodies"]["rock"].update({"angle": f"= math.sin({500 / L}*t)", "pivot": [0.4 * L] * 2})
        scene.works, scene.closed = True, False
        case.get("scheme", {}).pop("integrator", None)
    if scene.kind in ("line", "plane") and dice.coin(0.15):
        case["domain"]["velocity-components"] = 3
        for end in case["domain"]["boundaries"].values():
            if "velocity" in end and isinstance(end, dict):
                end["velocity"] += [0.0] * (3 - scene.dim)
        for layer in case["initial"]:
            layer["velocity"] = layer["velocity"] + [dice.number(-20, 20) for _ in range(3 - scene.dim)]
        if "sources" in case:
            case["sources"]["acceleration"] += [0.0] * (3 - scene.dim)
    if dice.coin(0.1):
        case.setdefault("sources", {})["heating"] = dice.power(8, 11)
        scene.works = True
        if case.get("scheme", {}).get("integrator") == "hancock":
            case["scheme"]["integrator"] = "ssprk3"
    if scene.conducts and not scene.pairs:
        for layer in case["initial"]:
            layer["temperature"] = dice.number(280, 400)


def wide_mesh(scene):
    dice, case = scene.dice, scene.case
    mesh, domain = case["mesh"], case["domain"]
    if dice.coin(0.4):
        mesh["tile"] = dice.pick(6 if "reconstruction" in case.get("scheme", {}) else 4, 6, 10, 16)
    for d in range(scene.dim):
        n = domain["cells"][d]
        factor = dice.pick(0.5, 0.75, 1.25) if d and dice.coin(0.4) else 1
        domain["cells"][d] = max(1, round(n * factor / mesh["tile"])) * mesh["tile"]
        domain["upper"][d] = domain["upper"][d] * domain["cells"][d] / n
    if mesh["levels"] and dice.coin(0.2):
        mesh["levels"] = min(mesh["levels"] + 1, 3 if scene.dim < 3 else 1)
    if mesh["levels"] and dice.coin(0.2):
        mesh["buffer"], mesh["patience"] = dice.pick(1, 2, 6), dice.pick(1, 3)
    if mesh["levels"] and dice.coin(0.15):
        mesh["reflux"] = "plain"


def wide_words(scene):
    dice, case = scene.dice, scene.case
    if dice.coin(0.2):
        case.setdefault("scheme", {})["mixture-speed"] = "frozen" if scene.solids else dice.pick("frozen", "wood")
    if dice.coin(0.15):
        case.setdefault("scheme", {})["first-step"] = 0.2
    for pair in case.get("phase-change", ()):
        words = {"direction": ("evaporation", "condensation"), "nucleus": (1e-4,), "onset": (0.0, 0.5, 0.99),
                 "condense-from": (0.0, 0.9), "gas-temperature": ("own",), "mixing": ("none",),
                 "rate": ("equilibrium", {"type": "hertz-knudsen", "area": 10 / scene.length}),
                 "condense-over": (3.0, 20.0)}
        for word, values in words.items():
            if word in ("nucleus", "condense-from", "condense-over") and pair.get("direction") == "evaporation":
                continue
            if word in ("onset", "condense-from") and "where" in pair:
                continue
            if word == "condense-over" and pair.get("rate", "equilibrium") != "equilibrium":
                continue
            if dice.coin(0.2) and (word not in ("gas-temperature", "mixing") or "gases" in pair):
                pair[word] = dice.pick(*values)


def widen(scene):
    for more in (wide_matter, wide_walls, wide_forces, wide_mesh, wide_words):
        more(scene)

def surfaces(scene):
    dice = scene.dice
    for word, values in (("surface-strain", ("share", "face")), ("surface-shear", ("free", "kept"))):
        if scene.solids and scene.fluids and dice.coin(0.4):
            scene.case.setdefault("scheme", {})[word] = dice.pick(*values)


def slants(scene, seed):
    ways = ("normal",) * (2 if seed < LIMITED else 3) + ("axes",)
    if scene.dim > 1 and scene.dice.coin(0.4):
        scheme = scene.case.setdefault("scheme", {})
        scheme["interface-along"] = scene.dice.pick(*ways)
        if seed >= LIMITED and scheme["interface-along"] != "axes" and scene.dice.coin(0.3):
            scheme["along-limiter"] = scene.dice.pick("minmod", "koren", "van-leer")


def waves(scene):
    """Waves of 0.01 to 100 MPa, some periods or less in the time of a run."""
    dice, ends = scene.dice, scene.case["domain"]["boundaries"]
    for face, end in ends.items():
        if end not in ("outflow", "non-reflecting") or not dice.coin(0.5):
            continue
        wave = {"type": "incoming-wave", "amplitude": 10.0 ** dice.number(4, 8)}
        beats = 1500 / scene.length * dice.power(-1, 1)
        wave.update(dice.pick({"pulse": "sine", "frequency": beats}, {"pulse": "lithotripter"},
                              {"pulse": "gaussian", "center": 1 / beats, "width": 0.5 / beats}))
        ends[face] = wave
        scene.works = True


def swirls(scene):
    """A velocity around the axis, in layers and of what flows in or drags along."""
    dice, case = scene.dice, scene.case
    fluid = scene.kind == "axis" and not scene.solids and not scene.bodies
    if not fluid or not dice.coin(0.5):
        return
    case["domain"]["velocity-components"] = 3
    for end in case["domain"]["boundaries"].values():
        if "velocity" in end and isinstance(end, dict):
            end["velocity"] = end["velocity"] + [dice.number(-20, 20)]
    for layer in case["initial"]:
        turn = f"= {dice.number(-30, 30):.3g}*x/{scene.length:.3g}"
        layer["velocity"] = layer.get("velocity", [0.0, 0.0]) + [turn]
    if "acceleration" in case.get("sources", {}):
        case["sources"]["acceleration"] += [0.0]
    if case.get("scheme", {}).get("integrator") == "hancock":
        case["scheme"]["integrator"] = "ssprk3"


def draw(seed):
    """A case, as a map that is JSON and YAML, and the Scene with what is known of it."""
    scene = Scene(seed)
    materials = {}
    domain(scene)
    fluids(scene, materials)
    solids(scene, materials)
    transport(scene, materials)
    scene.case["materials"] = materials
    exchange(scene)
    mesh(scene, initial(scene, materials))
    scheme(scene)
    if WIDE <= seed < LIVELY or seed > LIVELY and seed % 2:  # every other one of the lively ones
        widen(scene)
    columns = {name: {"mass": name} for name in materials}
    columns["E"] = {"total": "energy"}
    scene.case["run"] = {"until": 1.0, "max-steps": 16}
    scene.case["output"] = {"history": {"every": "2 steps", "columns": columns},
                            "checkpoints": {"every": "8 steps", "keep": 3}}
    if seed >= LIVELY:
        liven(scene)
    if seed >= SURFACES:
        surfaces(scene)
    if seed >= SLANTS:
        slants(scene, seed)
    if seed >= WAVES:
        waves(scene)
    if seed >= SWIRLS:
        swirls(scene)
    return scene.case, scene
