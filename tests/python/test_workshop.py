"""The workshop, a scene with all four materials, an emitter of water and one of sand, a drain and a paddle wheel, for 2 s:
all stays finite and bounded, every particle and its mass are accounted for, and matter does what such matter does."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pbmpm.lab.effects.catalogue import effects_on
from pbmpm.lab.frame import Frame
from pbmpm.lab.loading import load_scene
from pbmpm.lab.scenes.scene import Scene
from pbmpm.lab.simulation import RunSettings, Simulation

SECONDS = 2.0


@pytest.fixture(params=["workshop_2d", "workshop_3d"])
def scene(root: Path, request: pytest.FixtureRequest) -> Scene:
    return load_scene(root / "samples" / "scenes" / f"{request.param}.json")


def test_it_has_most_effects(scene: Scene) -> None:
    wanted = {"liquid", "elastic", "sand", "visco", "emitters", "drains", "moving_obstacles", "obstacles"}
    assert wanted <= set(effects_on(scene))


def run(scene: Scene, **changes: Any) -> tuple[Frame, dict[str, Any]]:
    with Simulation(scene, RunSettings.of(scene, **changes)) as simulation:
        for _ in range(round(SECONDS * simulation.settings.rate_hz)):
            simulation.step()
        assert simulation.problems() == []
        return simulation.frame(), simulation.figures()


@pytest.mark.parametrize("solver", ["paper", "dual"])
def test_nothing_breaks_and_nothing_is_lost(scene: Scene, solver: str) -> None:
    frame, figures = run(scene, solver=solver, rate_hz=60.0)
    account = figures["account"]
    assert account["deleted"] == account["missing"] == 0
    assert account["emitted"] > 0 and account["now"] == account["start"] + account["emitted"] - account["drained"]
    assert scene.domain is not None
    assert (frame.positions >= scene.domain.min).all() and (frame.positions <= scene.domain.max).all()
    height = scene.domain.max[1] - scene.domain.min[1]
    # Faster than a fall over twice the height only what the paddle throws, whose tips go at 0.8 m/s.
    assert frame.speeds.max() < (2 * 9.81 * 2 * height) ** 0.5 + 0.8


def test_matter_does_what_such_matter_does(root: Path) -> None:
    """Jelly lighter than water floats, sand lies in a heap with a slope, clay on a shelf neither falls apart nor runs away."""
    scene = load_scene(root / "samples" / "scenes" / "workshop_2d.json")
    frame, _ = run(scene)
    place = {name: frame.positions[frame.materials == row] for row, name in enumerate(scene.materials)}
    wall = scene.colliders[0].shape.position[0]
    assert np.mean(place["jelly"][:, 1]) > np.median(place["water"][:, 1])
    assert place["jelly"][:, 0].max() < wall
    column = next(fill for fill in scene.fills if fill.material == "sand").shape
    away = np.abs(place["sand"] - column.position) / column.half_extents
    heap = place["sand"][(away[:, 0] < 2) & (away[:, 1] < 1.5)]
    assert 0.3 < np.percentile(heap[:, 1], 99) / (2 * column.half_extents[1]) < 0.95
    clay = next(fill for fill in scene.fills if fill.material == "clay").shape
    assert np.linalg.norm(place["clay"] - place["clay"].mean(axis=0), axis=1).max() < 2 * clay.radius
