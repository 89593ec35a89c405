"""draw.py - scenes drawn at random: what no case of a person has, for hunt.py.

A seed gives a scene, always the same one: geometry, boundaries, levels, materials and their laws, what acts between
them, shapes painted over each other, and words of the scheme. Scenes are small and wild: pressures differ by tens,
shapes overlap, and matter meets at 100 m/s. What a case may not have together is not drawn.
"""
import random

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
    columns = {name: {"mass": name} for name in materials}
    columns["E"] = {"total": "energy"}
    scene.case["run"] = {"until": 1.0, "max-steps": 16}
    scene.case["output"] = {"history": {"every": "2 steps", "columns": columns},
                            "checkpoints": {"every": "8 steps", "keep": 3}}
    return scene.case, scene
