"""The matter of a running scene, ready to be put into another world: one whose materials or obstacles differ."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

import pbmpm
from pbmpm import Field

if TYPE_CHECKING:
    from .simulation import Simulation


LIQUID_RATIOS = (0.05, 1.2)
"""What a liquid's volume ratio can be: ``PBMPM_VOLUME_RATIO`` in ``particles.h``."""


@dataclass(frozen=True)
class State:
    """Particles at one moment, without their identities; the rows of all arrays belong together."""

    steps: int
    time: float
    """Simulated seconds."""
    positions: np.ndarray
    """(n, d) [m]"""
    velocities: np.ndarray
    """(n, d) [m/s]"""
    affine_velocities: np.ndarray
    """(n, d, d) [1/s]"""
    volume_ratios: np.ndarray
    """(n,)"""
    deformations: np.ndarray | None
    """(n, d, d), in a world that has them"""
    rest_volumes: np.ndarray
    """(n,) [m^d]"""
    materials: np.ndarray
    """(n,) names"""
    bodies: tuple[dict[str, Any], ...] = ()
    """States of the rigid bodies, in the order of the scene."""

    def __len__(self) -> int:
        return len(self.positions)


def state_of(simulation: Simulation) -> State:
    """A copy of what has become of a scene."""
    world = simulation.world
    names = np.array(list(simulation.scene.materials))[simulation.frame().materials]
    parts = simulation.scene.materials
    densities = np.array([parts[name].density for name in names], dtype=np.float32)
    deforms = any(parts[name].kind != "liquid" for name in np.unique(names))
    return State(
        simulation.steps,
        simulation.time,
        world.positions.copy(),
        world.velocities.copy(),
        world.affine_velocities.copy(),
        world.volume_ratios.copy(),
        world.deformations.copy() if deforms else None,
        world.masses.copy() / densities,
        names,
        simulation.body_states(),
    )


def put_into(world: pbmpm.World, materials: Mapping[str, pbmpm.Material], state: State) -> None:
    """Adds the particles of a state to a world. Matter that is of another kind there keeps of its strain what that kind can
    have."""
    for name, material in materials.items():
        chosen = state.materials == name
        if not chosen.any():
            continue
        ids = world.add_particles(
            material, state.positions[chosen], state.velocities[chosen], state.rest_volumes[chosen]
        )
        world.set(Field.AFFINE_VELOCITY, state.affine_velocities[chosen], ids)
        if isinstance(material.parameters, pbmpm.Liquid):
            world.set(Field.VOLUME_RATIO, np.clip(state.volume_ratios[chosen], *LIQUID_RATIOS), ids)
        elif state.deformations is not None:
            world.set(Field.DEFORMATION, state.deformations[chosen], ids)
