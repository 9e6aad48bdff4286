"""Import of the scene files of the PB-MPM demo that Electronic Arts published (2D, WebGPU).

The file is in pixels with y down; the demo divides by ``simResDivisor`` to get grid cells and keeps matter three cells
away from its border. The demo knows no metres. Here its scene is taken to be so tall that the demo's default gravity
(2.5 grid heights per s^2) is 9.81 m/s^2: the grid is always 3.924 m high, whatever its resolution. Every figure
in cells then has the same meaning as in the demo.

The demo has no moduli: its solids are as stiff as its rate and iterations make them. They get the moduli that this amounts to, so that
the solvers that take moduli show the same matter at other rates, where the demo's would be softer.

What cannot be carried over is noted, never fatal: the demo's border friction is a share of the tangential displacement
removed per iteration and becomes a Coulomb coefficient here; its ``iterationCount`` of n makes n - 1 complete rounds where
ours makes n; its sand yields by a constant for 3D, ours by that for 2D; its viscoplastic matter bounds each stretch, ours
the norm of their deviator; settings, fields, shapes and functions that nobody knows are left out.
"""

from __future__ import annotations

import math
from typing import Any

from .errors import InputError
from .parsing import parse_scene
from .scenes.scene import FORMAT_NAME, FORMAT_VERSION, SandPart, Scene, ViscoPart

STANDARD_GRAVITY = 9.81
DEFAULT_STRENGTH = 2.5
GUARDIAN_CELLS = 3
DEFAULT_SECONDS = 10.0
MAX_RELAXATION = 1.99

DEFAULTS = {
    "simResDivisor": 8.0,
    "particlesPerCellAxis": 2.0,
    "simRate": 240.0,
    "useGridVolumeForLiquid": 1.0,
    "gravityStrength": DEFAULT_STRENGTH,
    "liquidViscosity": 0.01,
    "iterationCount": 5.0,
    "elasticityRatio": 1.0,
    "liquidRelaxation": 1.5,
    "elasticRelaxation": 1.5,
    "frictionAngle": 30.0,
    "plasticity": 0.9,
    "borderFriction": 0.5,
}
"""Settings that mean something to a simulation, with the demo's defaults."""

MATERIALS = {0: "liquid", 1: "elastic", 2: "sand", 3: "visco"}
FUNCTIONS = {0: "emitter", 1: "collider", 2: "drain", 3: "initial fill"}
SHAPES = {0: "box", 1: "circle"}
AT_ONCE = 1e9
"""[1/s] a flow rate at which strain beyond the yield is gone after a step, as in the demo."""
KNOWN_FIELDS = {"id", "position", "halfSize", "rotation", "shape", "function", "emitMaterial", "emissionRate", "radius"}


DENSITY: float = ViscoPart.model_fields["density"].default
"""[kg/m^3] of all matter; the demo knows no mass."""

EMITTER_FILL_LIMIT = 1.5
"""The demo emits no liquid where the nearest cell holds more than this: enough to pump up a pool from below."""


def looks_like_ea_scene(data: Any) -> bool:
    """True for a decoded file with the demo's fields."""
    return isinstance(data, dict) and "format" not in data and "resolution" in data and "shapes" in data


def import_ea_scene(data: dict[str, Any], source: str) -> Scene:
    """Turns a decoded file of the demo into a Scene; what it cannot carry over becomes a note of the scene.

    ``source`` is the name of the file: it begins each message and gives the scene its name.
    """
    settings, notes = _settings(data, source)
    shapes = _shapes(_list(data, "shapes", source), source, notes)
    width, height = _grid(data, settings["simResDivisor"], source)
    cell_size = STANDARD_GRAVITY / (DEFAULT_STRENGTH * height)
    scale = cell_size / settings["simResDivisor"]
    parts = [shape.as_part(scale, height * cell_size) for shape in shapes]
    if any(shape.function == "emitter" and shape.material != "liquid" for shape in shapes):
        notes.append("emitters of solids, too, stop where the grid is overfull; the demo's never do")
    scene = {
        "format": FORMAT_NAME,
        "version": FORMAT_VERSION,
        "name": _safe_name(source.removesuffix(".json")),
        "description": "imported from a scene of the EA demo",
        "dimension": 2,
        "cell_size": cell_size,
        "gravity": [0.0, -settings["gravityStrength"] * height * cell_size],
        "domain": _domain(width, height, cell_size, settings["borderFriction"]),
        "seconds": DEFAULT_SECONDS,
        "rate_hz": settings["simRate"],
        "iterations": int(settings["iterationCount"]),
        "solver": {"solver": "paper"},
        "materials": _materials(settings, cell_size, {shape.material for shape in shapes if shape.emits}, notes),
        "fills": [
            _fill(s, p, i, settings) for i, (s, p) in enumerate(zip(shapes, parts)) if s.function == "initial fill"
        ],
        "colliders": [{"shape": p} for s, p in zip(shapes, parts) if s.function == "collider"],
        "emitters": [_emitter(s, p, i, settings) for i, (s, p) in enumerate(zip(shapes, parts)) if s.function == "emitter"],
        "drains": [{"shape": p} for s, p in zip(shapes, parts) if s.function == "drain"],
        "pictures": {"colour": "material"},
        "notes": notes,
    }
    return parse_scene(scene, source)


class _Shape:
    """One entry of ``shapes``, decoded but still in pixels."""

    def __init__(self, item: Any, index: int, source: str) -> None:
        where = f"{source}: shapes[{index}]"
        if not isinstance(item, dict):
            raise InputError(f"{where}: must be an object")
        self.where = where
        self.kind = _choice(item, "shape", SHAPES, where)
        self.function = _choice(item, "function", FUNCTIONS, where)
        self.material = _choice(item, "emitMaterial", MATERIALS, where) if "emitMaterial" in item else "liquid"
        self.position = _pair(item, "position", where)
        self.rotation = math.radians(_number(item, "rotation", where)) if "rotation" in item else 0.0
        self.half_size = _pair(item, "halfSize", where) if self.kind == "box" else None
        self.radius = _number(item, "radius", where) if self.kind == "circle" else None
        self.emission_rate = _number(item, "emissionRate", where) if "emissionRate" in item else 0.0

    @property
    def emits(self) -> bool:
        return self.function in ("emitter", "initial fill")

    def as_part(self, scale: float, height: float) -> dict[str, Any]:
        """The shape in metres, y up. The demo turns clockwise as seen, so the angle changes its sign."""
        position = [self.position[0] * scale, height - self.position[1] * scale]
        if self.kind == "circle":
            return {"kind": "sphere", "position": position, "radius": self.radius * scale}
        half_extents = [size * scale for size in self.half_size]
        return {"kind": "box", "position": position, "half_extents": half_extents, "rotation": -self.rotation}


def _shapes(items: list[Any], source: str, notes: list[str]) -> list[_Shape]:
    """The shapes that mean something here."""
    shapes = []
    for index, item in enumerate(items):
        where = f"{source}: shapes[{index}]"
        strange = _strange_kinds(item, where) if isinstance(item, dict) else []
        notes += [f"shapes[{index}] was left out: {problem}" for problem in strange]
        if not strange:
            shapes.append(_Shape(item, index, source))
    fields = sorted({field for item in items if isinstance(item, dict) for field in item} - KNOWN_FIELDS)
    notes += [f"the field '{field}' of shapes has no meaning here and was ignored" for field in fields]
    if not any(shape.emits for shape in shapes):
        raise InputError(f"{source}: shapes: nothing fills this scene (no shape with function 3 or 0)")
    return shapes


def _strange_kinds(item: dict[str, Any], where: str) -> list[str]:
    """Shapes, functions and materials that are numbered as nothing that is known."""
    found = []
    for field, names in (("shape", SHAPES), ("function", FUNCTIONS), ("emitMaterial", MATERIALS)):
        if field in item and (value := _number(item, field, where)) not in names:
            found.append(f"{field} {value:g} is not known")
    return found


def _settings(data: dict[str, Any], source: str) -> tuple[dict[str, float], list[str]]:
    settings, unknown = dict(DEFAULTS), []
    entries = _list(data, "settings", source) if "settings" in data else []
    for index, entry in enumerate(entries):
        where = f"{source}: settings[{index}]"
        if not isinstance(entry, dict) or not isinstance(entry.get("name"), str):
            raise InputError(f"{where}.name: this field is required")
        if entry["name"] in settings:
            settings[entry["name"]] = _number(entry, "value", where)
        else:
            unknown.append(entry["name"])
    notes = [f"setting '{setting}' has no meaning here and was ignored" for setting in unknown]
    for name in ("simResDivisor", "particlesPerCellAxis", "simRate", "iterationCount"):
        if not settings[name] > 0:
            raise InputError(f"{source}: settings.{name}: must be greater than 0")
    return settings, notes


def _materials(settings: dict[str, float], cell_size: float, used: set[str], notes: list[str]) -> dict[str, Any]:
    notes.append("border friction is a Coulomb coefficient here; the demo removes a share of the motion per iteration")
    notes.append("N iterations are N complete rounds here; the demo makes one fewer")
    liquid = {
        "kind": "liquid",
        "relaxation": _relaxation(settings, "liquidRelaxation", notes),
        "viscosity": min(max(settings["liquidViscosity"], 0.0), 1.0),
        "volume_feedback": 0.1 if settings["useGridVolumeForLiquid"] else 0.0,
    }
    relaxation = _relaxation(settings, "elasticRelaxation", notes)
    solid = {"relaxation": relaxation, **_moduli(settings, cell_size, relaxation)}
    ratio = settings["elasticityRatio"]
    elastic = {"kind": "elastic", **solid, "elasticity_ratio": min(max(ratio, 0.0), 1.0)}
    sand = {
        "kind": "sand",
        **solid,
        "elasticity_ratio": _within(SandPart, "elasticity_ratio", ratio),
        "friction_angle": _within(SandPart, "friction_angle", math.radians(settings["frictionAngle"])),
    }
    # The demo keeps ln of each stretch within 1 - plasticity, and the volume: a deviator (a, -a) of norm sqrt(2) a.
    visco = {
        "kind": "visco",
        **solid,
        "elasticity_ratio": _within(ViscoPart, "elasticity_ratio", ratio),
        "yield_strain": _within(ViscoPart, "yield_strain", math.sqrt(2) * (1 - settings["plasticity"])),
        "flow_rate": AT_ONCE,
    }
    materials = {"liquid": liquid, "elastic": elastic, "sand": sand, "visco": visco}
    return {name: material for name, material in materials.items() if name in used}


def _moduli(settings: dict[str, float], cell_size: float, relaxation: float) -> dict[str, float]:
    """Young's modulus and Poisson's ratio that the demo's solids act like.

    N iterations answer a strain like the modulus k = density w N dx^2 / (4 dt^2): a volume strain in full, a deviator by the share ``elasticityRatio``, b.
    With 2 mu = b k and K = lambda + mu = k / 2 in 2D, nu = lambda / (2 K) = (1 - b) / 2 and E = 2 mu (1 + nu).
    """
    ratio = _within(ViscoPart, "elasticity_ratio", settings["elasticityRatio"])
    stiffness = 0.25 * DENSITY * relaxation * int(settings["iterationCount"]) * (cell_size * settings["simRate"]) ** 2
    poisson = 0.5 * (1 - ratio)
    return {
        "young_modulus": _within(ViscoPart, "young_modulus", ratio * stiffness * (1 + poisson)),
        "poisson_ratio": _within(ViscoPart, "poisson_ratio", poisson),
    }


def _within(part: type[SandPart | ViscoPart], field: str, value: float) -> float:
    """The nearest value that the format of scenes allows."""
    for bound in part.model_fields[field].metadata:
        value = max(value, getattr(bound, "ge", value))
        value = min(value, getattr(bound, "le", value))
    return value


def _relaxation(settings: dict[str, float], name: str, notes: list[str]) -> float:
    """The demo's slider goes to 10, where its iteration diverges; ours stays below 2."""
    if settings[name] <= MAX_RELAXATION:
        return settings[name]
    notes.append(f"{name} {settings[name]:g} was lowered to {MAX_RELAXATION}: the iteration diverges from 2 on")
    return MAX_RELAXATION


def _fill(shape: _Shape, part: dict[str, Any], index: int, settings: dict[str, float]) -> dict[str, Any]:
    return {
        "shape": part,
        "material": shape.material,
        "particles_per_axis": settings["particlesPerCellAxis"],
        "seed": index + 1,
    }


def _emitter(shape: _Shape, part: dict[str, Any], index: int, settings: dict[str, float]) -> dict[str, Any]:
    """The demo lets each site of a lattice emit so often per second: the whole area as often."""
    area = math.pi * part["radius"] ** 2 if part["kind"] == "sphere" else 4 * math.prod(part["half_extents"])
    return {
        "shape": part,
        "material": shape.material,
        "rate": max(shape.emission_rate, 0.0) * area,
        "particles_per_axis": settings["particlesPerCellAxis"],
        "fill_limit": EMITTER_FILL_LIMIT,
        "seed": index + 1,
    }


def _domain(width: int, height: int, cell_size: float, friction: float) -> dict[str, Any]:
    border = GUARDIAN_CELLS * cell_size
    return {
        "min": [border, border],
        "max": [width * cell_size - border, height * cell_size - border],
        "friction": friction,
    }


def _grid(data: dict[str, Any], divisor: float, source: str) -> tuple[int, int]:
    resolution = _list(data, "resolution", source)
    try:
        width, height = (math.floor(float(value) / divisor) for value in resolution)
    except (TypeError, ValueError):
        raise InputError(f"{source}: resolution: two numbers are needed") from None
    smallest = 2 * GUARDIAN_CELLS + 4
    if width < smallest or height < smallest:
        raise InputError(f"{source}: resolution: gives {width} x {height} cells; at least {smallest} each are needed")
    return width, height


def _list(data: dict[str, Any], field: str, source: str) -> list[Any]:
    if not isinstance(data.get(field), list):
        raise InputError(f"{source}: {field}: a list is needed")
    return data[field]


def _number(item: dict[str, Any], field: str, where: str) -> float:
    """A number that the file may hold as a string or a boolean."""
    try:
        value = float({"true": 1, "false": 0}.get(item[field], item[field]))
    except KeyError:
        raise InputError(f"{where}.{field}: this field is required") from None
    except (TypeError, ValueError):
        raise InputError(f"{where}.{field}: {item[field]!r} is not a number") from None
    if not math.isfinite(value):
        raise InputError(f"{where}.{field}: must be finite")
    return value


def _pair(item: dict[str, Any], field: str, where: str) -> tuple[float, float]:
    value = item.get(field)
    if not isinstance(value, dict):
        raise InputError(f"{where}.{field}: an object with x and y is needed")
    return _number(value, "x", f"{where}.{field}"), _number(value, "y", f"{where}.{field}")


def _choice(item: dict[str, Any], field: str, names: dict[int, str], where: str) -> str:
    value = _number(item, field, where)
    if value not in names:
        raise InputError(f"{where}.{field}: {value:g} is not known (there are: {names})")
    return names[int(value)]


def _safe_name(name: str) -> str:
    return "".join(c if c.isalnum() and c.isascii() or c in "_.-" else "_" for c in name)[:80] or "scene"
