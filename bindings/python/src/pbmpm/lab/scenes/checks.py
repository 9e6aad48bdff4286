"""What no single field of a scene shows: vector lengths, references, the size of the domain."""

from __future__ import annotations

import math

from ..._fixed import nearest
from .scene import CameraPart, KeyframePart, Part, Scene, material_groups

#: Bits of the groups of a material.
MATERIALS_THAT_CAN_BE_MET = 32


def scene_problems(scene: Scene) -> list[str]:
    """What no single field shows: vector lengths, references, domain size."""
    problems = list(_vector_problems(scene, scene.dimension, ""))
    if not scene.sources:
        problems.append("fills: there is nothing in the scene: it needs a fill or an emitter")
    problems += _material_problems(scene)
    if max(material_groups(scene).values()).bit_length() > MATERIALS_THAT_CAN_BE_MET:
        problems.append(f"colliders: `meets` works with {MATERIALS_THAT_CAN_BE_MET} materials at most")
    for index, part in enumerate(scene.colliders):
        if scene.dimension == 2 and part.body is not None and part.body.axis is not None:
            problems.append(f"colliders[{index}].body.axis: in 2D a body turns in the plane")
    for name in ("colliders", "drains", "forces"):
        for index, part in enumerate(getattr(scene, name)):
            if part.shape is not None and part.shape.kind == "plane" and math.hypot(*part.shape.normal) < 1e-6:
                problems.append(f"{name}[{index}].shape.normal: must not be zero")
    for name in ("emitters", "forces"):
        for index, part in enumerate(getattr(scene, name)):
            if part.direction is not None and math.hypot(*part.direction) < 1e-6:
                problems.append(f"{name}[{index}].direction: must not be zero")
    bounds = scene.kill_bounds
    if bounds is not None and any(high <= low for low, high in zip(bounds.min, bounds.max)):
        problems.append("kill_bounds.max: must be above kill_bounds.min on every axis")
    if scene.domain is not None and not problems:
        for axis in range(scene.dimension):
            if scene.domain.max[axis] - scene.domain.min[axis] < 4 * scene.cell_size:
                problems.append(f"domain.max[{axis}]: must be at least 4 cells above domain.min[{axis}]")
    return problems


def _material_problems(scene: Scene) -> list[str]:
    """Materials that are named but not there."""
    named = [
        (f"{name}[{index}].material", part.material)
        for name in ("fills", "emitters", "drains")
        for index, part in enumerate(getattr(scene, name))
    ]
    named += [(f"colliders[{index}].meets", name) for index, part in enumerate(scene.colliders) for name in part.meets or ()]
    known = ", ".join(sorted(scene.materials))
    return [
        f"{where}: no material is called '{material}' (there are: {known}){nearest(material, scene.materials)}"
        for where, material in named
        if material is not None and material not in scene.materials
    ]


def _vector_problems(part: Part, dimension: int, path: str):
    """Yields a complaint for each vector or rotation that does not fit the dimension."""
    for name in type(part).model_fields:
        value = getattr(part, name)
        where = f"{path}.{name}" if path else name
        if isinstance(value, CameraPart):
            continue
        if isinstance(value, Part):
            yield from _vector_problems(value, dimension, where)
        elif name == "rotation":
            yield from _rotation_problems(value, dimension, where, math.inf if isinstance(part, KeyframePart) else math.tau)
        elif isinstance(value, dict):
            continue
        elif isinstance(value, list) and value and isinstance(value[0], Part):
            for index, item in enumerate(value):
                yield from _vector_problems(item, dimension, f"{where}[{index}]")
        elif name in type(part).vectors() and value is not None and len(value) != dimension:
            yield f"{where}: needs {dimension} numbers in a scene of dimension {dimension}, has {len(value)}"


def _rotation_problems(value: float | list[float], dimension: int, where: str, most: float):
    if isinstance(value, list):
        if dimension == 2:
            yield f"{where}: in 2D this is one angle in radians"
        elif not 0.5 <= math.hypot(*value) <= 2:
            yield f"{where}: a quaternion (x, y, z, w) of length 1 is needed"
    elif dimension == 3 and value != 0:
        yield f"{where}: in 3D this is a quaternion [x, y, z, w]"
    elif abs(value) > most:
        yield f"{where}: an angle in radians, at most a whole turn; {value:g} degrees are {math.radians(value):.4g}"
