"""Import of the scene files of the PB-MPM demo that Electronic Arts published (2D, WebGPU).

The file is in pixels with y down; the demo divides by ``simResDivisor`` to get grid cells and keeps matter three cells
away from its border. The demo knows no metres. Here its scene is taken to be so tall that the demo's default gravity
(2.5 grid heights per s^2) is 9.81 m/s^2: the grid is always 3.924 m high, whatever its resolution. Every figure
in cells then has the same meaning as in the demo.

Two things cannot be carried over exactly and are noted: the demo's border friction is a share of the tangential
displacement removed per iteration and becomes a Coulomb coefficient here, and its ``iterationCount`` of n makes n - 1
complete rounds where ours makes n.
"""

from __future__ import annotations

import math
from typing import Any

from .errors import InputError
from .scene import FORMAT_NAME, FORMAT_VERSION, Scene, parse_scene

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
KNOWN_MATERIALS = ("liquid", "elastic")
KNOWN_FUNCTIONS = ("collider", "initial fill")


def looks_like_ea_scene(data: Any) -> bool:
    """True for a decoded file with the demo's fields."""
    return isinstance(data, dict) and "format" not in data and "resolution" in data and "shapes" in data


def import_ea_scene(data: dict[str, Any], source: str) -> Scene:
    """Turns a decoded file of the demo into a Scene; refuses by name what is not supported.

    ``source`` is the name of the file: it begins each message and gives the scene its name.
    """
    settings, notes = _settings(data, source)
    shapes = [_Shape(item, index, source) for index, item in enumerate(_list(data, "shapes", source))]
    _refuse_unsupported(shapes, source)
    width, height = _grid(data, settings["simResDivisor"], source)
    cell_size = STANDARD_GRAVITY / (DEFAULT_STRENGTH * height)
    scale = cell_size / settings["simResDivisor"]
    parts = [shape.as_part(scale, height * cell_size) for shape in shapes]
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
        "materials": _materials(settings, notes),
        "fills": [
            _fill(s, p, i, settings) for i, (s, p) in enumerate(zip(shapes, parts)) if s.function == "initial fill"
        ],
        "colliders": [{"shape": p} for s, p in zip(shapes, parts) if s.function == "collider"],
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


def _refuse_unsupported(shapes: list[_Shape], source: str) -> None:
    problems = []
    for shape in shapes:
        if shape.function not in KNOWN_FUNCTIONS:
            problems.append(f"{shape.where}.function: '{shape.function}' is not supported yet")
        if shape.emits and shape.material not in KNOWN_MATERIALS:
            problems.append(f"{shape.where}.emitMaterial: the material '{shape.material}' is not supported yet")
    if problems:
        raise InputError("\n".join(problems))
    if not any(shape.function == "initial fill" for shape in shapes):
        raise InputError(f"{source}: shapes: nothing fills this scene (no shape with function 3)")


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


def _materials(settings: dict[str, float], notes: list[str]) -> dict[str, Any]:
    notes.append("border friction is a Coulomb coefficient here; the demo removes a share of the motion per iteration")
    notes.append("N iterations are N complete rounds here; the demo makes one fewer")
    return {
        "liquid": {
            "kind": "liquid",
            "relaxation": _relaxation(settings, "liquidRelaxation", notes),
            "viscosity": settings["liquidViscosity"],
            "volume_feedback": 0.1 if settings["useGridVolumeForLiquid"] else 0.0,
        },
        "elastic": {
            "kind": "elastic",
            "relaxation": _relaxation(settings, "elasticRelaxation", notes),
            "elasticity_ratio": settings["elasticityRatio"],
        },
    }


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
