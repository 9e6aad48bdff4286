"""What pictures and files are made from: a copy of all particles at one moment."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Frame:
    """Particles at one moment; the rows of all arrays belong together. ``d`` is the dimension."""

    time: float
    """Simulated seconds."""
    step: int
    positions: np.ndarray
    """(n, d) float32 [m]"""
    velocities: np.ndarray
    """(n, d) float32 [m/s]"""
    volume_ratios: np.ndarray
    """(n,) float32, J"""
    materials: np.ndarray
    """(n,) uint8: position of the material in the scene's list of materials"""
    ids: np.ndarray
    """(n, 2) uint32: index and generation; stable over the life of a particle"""
    body_poses: dict[int, tuple[list[float], list[float]]] = field(default_factory=dict)
    """Position (3 components) and quaternion of the scene's colliders, by index, that matter moves"""
    radii: np.ndarray | None = None
    """(n,) float32 [m]: of a ball (2D: a disc) of the particle's volume"""

    @property
    def dimension(self) -> int:
        return self.positions.shape[1]

    @property
    def speeds(self) -> np.ndarray:
        """(n,) [m/s]"""
        return np.linalg.norm(self.velocities, axis=1)
