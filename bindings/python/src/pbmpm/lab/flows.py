"""What adds, takes and pushes matter in a scene: its emitters, drains, kill bounds and forces, brought to life."""

from __future__ import annotations

import math
from typing import Any

import pbmpm

from .scenes.motion import pose_at
from .scenes.scene import EmitterPart, Scene

FULL = 2.0
"""More of its volume than this is never in a closed domain: emitters stop long before."""
LONGER = 2.0
"""A run may last so much longer than the scene says before there is no room for what its emitters bring."""


class Flows:
    """The flows and forces of one world."""

    def __init__(self, world: pbmpm.World, scene: Scene, materials: dict[str, pbmpm.Material], time: float) -> None:
        """``time`` [s] is when the world begins."""
        self._world, self._dimension = world, scene.dimension
        self._emitters = [(_add_emitter(world, part, materials, time), part) for part in scene.emitters]
        self._drains = []
        for drain in scene.drains:
            material = None if drain.material is None else materials[drain.material]
            self._drains.append((world.add_drain(shape_of(drain.shape), material=material), drain))
        self._forces = [(_add_force(world, part), part) for part in scene.forces]
        if scene.kill_bounds is not None:
            world.kill_bounds = (scene.kill_bounds.min, scene.kill_bounds.max)
        self._timed = [*self._emitters, *self._drains, *self._forces]
        self._on: dict[int, bool] = {}

    @property
    def switched(self) -> dict[int, bool]:
        """What of the timed parts works, as the world knows it; assigned when the world went back to a snapshot."""
        return dict(self._on)

    @switched.setter
    def switched(self, value: dict[int, bool]) -> None:
        self._on = dict(value)

    def before_step(self, time: float, dt: float) -> None:
        """Switches on and off what has its time, and sends the emitters on their way."""
        for index, (thing, part) in enumerate(self._timed):
            on = part.works_at(time)
            if self._on.get(index) is not on:
                thing.enabled = self._on[index] = on
        for emitter, part in self._emitters:
            if part.motion is not None:
                position, rotation = pose_at(part.motion, time + dt)
                emitter.move(position[: self._dimension], rotation)

    def figures(self) -> dict[str, Any]:
        """The account for a report; nothing for a scene in which nothing flows."""
        if not (self._emitters or self._drains or self._world.kill_bounds):
            return {}
        flow = self._world.flow
        names = ("emitted", "refused", "drained", "killed", "emitted_mass", "drained_mass", "killed_mass")
        return {
            **{name: getattr(flow, name) for name in names},
            "emitters": [_emitter_figures(emitter) for emitter, _ in self._emitters],
            "drains": [{"drained": drain.status.drained, "mass": drain.status.drained_mass} for drain, _ in self._drains],
        }


def _emitter_figures(emitter: pbmpm.Emitter) -> dict[str, Any]:
    status = emitter.status
    return {
        "emitted": status.emitted,
        "mass": status.emitted_mass,
        "refused_full": status.refused_full,
        "refused_budget": status.refused_budget,
        "refused_capacity": status.refused_capacity,
    }


def _add_emitter(
    world: pbmpm.World, part: EmitterPart, materials: dict[str, pbmpm.Material], time: float
) -> pbmpm.Emitter:
    emitter = world.add_emitter(
        shape_of(part.shape),
        materials[part.material],
        part.rate,
        region=part.region,
        speed=part.speed,
        direction=part.direction,
        spread=part.spread,
        particles_per_axis=part.particles_per_axis,
        fill_limit=part.fill_limit,
        budget=part.budget,
        seed=part.seed,
    )
    if part.motion is not None:
        start = shape_of(part.shape, *pose_at(part.motion, time))
        emitter.change(shape=start)
    return emitter


def _add_force(world: pbmpm.World, part: Any) -> pbmpm.Force:
    return world.add_force(
        part.kind,
        part.strength,
        shape=None if part.shape is None else shape_of(part.shape),
        falloff=part.falloff,
        range=part.range,
        direction=part.direction,
        velocity=part.velocity,
        spin=part.spin,
    )


def emitted_at_most(scene: Scene) -> int:
    """Particles that emitters can bring in twice the time of the scene, or as many as fit into its domain twice."""
    total, finest = 0.0, 0.0
    for part in scene.emitters:
        volume = (scene.cell_size / part.particles_per_axis) ** scene.dimension
        seconds = (LONGER * scene.seconds if part.stop is None else part.stop) - part.start
        due = math.ceil(part.rate * max(seconds, 0.0) / volume) + 1
        total += min(due, part.budget) if part.budget else due
        finest = max(finest, 1 / volume)
    if scene.domain is not None:
        size = math.prod(high - low for low, high in zip(scene.domain.min, scene.domain.max))
        total = min(total, math.ceil(FULL * size * finest))
    return int(min(total, 2**26))


def shape_of(part: Any, position: Any = None, rotation: Any = None) -> pbmpm.Shape:
    """The shape of a part of a scene, with its own pose or another one (three components; a quaternion)."""
    kinds = {"plane": pbmpm.Plane, "box": pbmpm.Box, "sphere": pbmpm.Sphere, "capsule": pbmpm.Capsule}
    values = part.model_dump(exclude={"kind"})
    if position is not None:
        values["position"] = position[: len(part.position)]
    if rotation is not None and "rotation" in values:
        values["rotation"] = rotation
    return kinds[part.kind](**values)
