"""What of an error is seen first: liquids that stand too low or too high, solids that sag."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..scenes.scene import Scene
from .observe import Observation, Sample

#: Percentiles of the heights between which a material stands; single drops and crumbs lie beyond.
TOP, BOTTOM = 95.0, 5.0


@dataclass(frozen=True)
class Visible:
    """How far the top of a material is from where the converged solution has it, on average over the samples."""

    material: str
    solid: bool
    cells: float  #: above 0: too high
    share: float  #: of the height that the material has in the converged solution

    def text(self) -> str:
        """For people: "water 0.8 cells (4 %) too low"."""
        way = "too high" if self.cells > 0.0 else "sags" if self.solid else "too low"
        figure = f"{abs(self.cells):.2g} cells ({100 * abs(self.share):.2g} %)"
        return f"{self.material} sags by {figure}" if way == "sags" else f"{self.material} stands {figure} {way}"


def visible(scene: Scene, one: Observation, other: Observation) -> Visible | None:
    """The material whose top is farthest off; None without gravity, where nothing stands."""
    gravity = np.array(scene.gravity, dtype=float)
    if not gravity.any() or not other.samples:
        return None
    up = -gravity / np.linalg.norm(gravity)
    found = [_of(scene, index, up, one, other) for index in range(len(scene.materials))]
    return max((item for item in found if item is not None), key=lambda item: abs(item.cells), default=None)


def _of(scene: Scene, index: int, up: npt.NDArray[np.float64], one: Observation, other: Observation) -> Visible | None:
    pairs = [(_ends(a, index, up), _ends(b, index, up)) for a, b in zip(one.samples, other.samples, strict=True)]
    known = [(a, b) for a, b in pairs if a is not None and b is not None]
    if not known:
        return None
    name, part = list(scene.materials.items())[index]
    offset = float(np.mean([a[0] - b[0] for a, b in known]))
    height = float(np.mean([b[0] - b[1] for _, b in known]))
    return Visible(name, part.kind != "liquid", offset / scene.cell_size, offset / height if height > 0.0 else math.nan)


def _ends(sample: Sample, material: int, up: npt.NDArray[np.float64]) -> tuple[float, float] | None:
    """Top and bottom of a material [m]; None where there is none of it."""
    own = sample.positions[sample.materials == material]
    if not len(own):
        return None
    top, bottom = np.percentile(own.astype(float) @ up, [TOP, BOTTOM])
    return float(top), float(bottom)
