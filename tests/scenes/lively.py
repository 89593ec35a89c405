"""lively.py - what scenes of draw.py from seed 2000 on have more: levels that come and go for some 50 steps, for reasons of
every kind, and all kinds of output. What they show is the same on any ranks and after a restart.
"""


def lively_mesh(scene):
    dice, mesh = scene.dice, scene.case["mesh"]
    before = mesh["tile"]
    mesh["tile"] = dice.pick(6, 8) if "reconstruction" in scene.case.get("scheme", {}) else dice.pick(4, 4, 8)
    most = {1: 32, 2: 24, 3: 12}[scene.dim]
    domain = scene.case["domain"]
    if "bodies" in scene.case:  # which have their places
        mesh["tile"] = before if any(n % 8 for n in domain["cells"]) else 8
    for d in range(scene.dim if "bodies" not in scene.case else 0):
        n = domain["cells"][d]
        domain["cells"][d] = max(1, min(most, n) // mesh["tile"]) * mesh["tile"]
        domain["upper"][d] = domain["upper"][d] * domain["cells"][d] / n
    mesh["levels"] = dice.pick(1, 2, 2, 3) if scene.dim < 3 else dice.pick(1, 1, 2)
    mesh["regrid-every"], mesh["buffer"], mesh["patience"] = dice.pick(1, 2, 3, 4), dice.pick(0, 1, 2, 4), dice.pick(1, 1, 2, 3)
    mesh["subcycle"] = dice.coin(0.75)
    mesh["refine"] = [lively_reason(scene) for _ in range(dice.pick(1, 1, 2, 3))]


def lively_reason(scene):
    """One criterion of refinement, perhaps for coarser levels, a part of the domain or a time alone."""
    dice, (first, *_) = scene.dice, scene.case["initial"]
    p, x = first["pressure"], scene.case["domain"]["upper"][0]
    moment = scene.length / 1500.0 / scene.case["domain"]["cells"][0]
    reason = dice.pick({"jump": "pressure", "above": dice.pick(0.02, 0.1, 0.5)},
                       {"jump": "density", "above": dice.pick(0.01, 0.1)},
                       {"jump": "velocity", "above": dice.pick(0.1, 0.5)},
                       {"value": "pressure", "above": p * dice.pick(0.9, 1.001, 1.5, 4)},
                       {"value": "pressure", "below": p * dice.pick(0.7, 0.999)},
                       {"gradient": "schlieren", "above": dice.pick(0.1, 0.5)},
                       {"interface": dice.pick(*scene.fluids)},
                       {"lua": f"= pressure > {1.01 * p} and x < {0.7 * x}"},
                       {"lua": f"= x > {0.3 * x} and x < {0.5 * x} + {100 * dice.pick(-1, 1)} * t"},
                       {"region": {"sphere": {"center": [0.5 * x] * scene.dim if scene.kind != "ball" else [0.0],
                                              "radius": dice.number(0.1 * x, 0.4 * x)}}})
    if "interface" in reason and len(scene.case["materials"]) < 2:
        reason = {"jump": "pressure", "above": 0.1}
    if scene.case["mesh"]["levels"] > 1 and dice.coin(0.3):
        reason["finest"] = 1
    if dice.coin(0.2):
        reason["until"] = moment * dice.number(1, 30)
    elif dice.coin(0.15):
        reason["from"] = moment * dice.number(1, 30)
    if "region" not in reason and dice.coin(0.15):
        reason["where"] = {"box": {"lower": [0.0] * scene.dim, "upper": [0.6 * x] * scene.dim}}
    return reason


def lively_ends(scene):
    """Waves leave half of the scenes."""
    dice, ends = scene.dice, scene.case["domain"]["boundaries"]
    if not dice.coin():
        return
    for face, end in ends.items():
        if end in ("reflecting", "symmetry") and not (scene.curved and face == "x-"):
            ends[face] = dice.pick("outflow", "non-reflecting", end)
            scene.closed = scene.closed and ends[face] == end


def lively_output(scene):
    dice, case, (x, *_) = scene.dice, scene.case, scene.case["domain"]["upper"]
    fluid, middle = dice.pick(*scene.fluids), [0.5 * end for end in case["domain"]["upper"]]
    one = [dice.number(0.0, 0.99 * end) for end in case["domain"]["upper"]]
    fields = ["density", "pressure", "velocity", "schlieren", "level", f"alpha_{fluid}"]
    case["run"] = {"until": 1.0, "max-steps": 48}
    output = case["output"]
    output["checkpoints"] = {"every": "24 steps", "keep": 3}
    output["history"]["every"] = dice.pick("1 steps", "3 steps")
    output["history"]["steps-of"] = dice.pick("coarsest", "finest")
    output["history"]["columns"].update(
        finest={"max": "level"}, fast={"max": "velocity_x"}, low={"min": "pressure"}, mean={"mean": "density"},
        sum={"integral": "pressure"}, edge={"max": "schlieren"}, V={"volume": fluid}, at={"centroid": fluid, "along": "x"},
        least={"min-between": "low"})
    if dice.coin(0.3) and len(case["materials"]) > 1:
        output["history"]["columns"]["on"] = {"isosurface-mean": "pressure", "in": fluid}
    output["snapshots"] = {"every": "16 steps", "fields": fields, "precision": "double"}
    output["probes"] = {"every": dice.pick("1 steps", "2 steps"), "in": {"at": middle, "fields": ["pressure", "level"]},
                        "out": {"at": one, "fields": ["velocity"]}}
    if scene.dim == 2 and dice.coin(0.5):
        output["maps"] = {"every": "4 steps", "cut": {"line": {"from": [0.0, 0.0], "to": [x, middle[1]]},
                                                      "fields": ["pressure", "level"]}}
    if dice.coin(0.2):
        output["writers"] = 2


def liven(scene):
    for more in (lively_mesh, lively_ends, lively_output):
        more(scene)
