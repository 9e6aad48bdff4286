"""The scenes at the pace of a game: each goes on for a moment and accounts for every particle, and the bodies in them move as they should."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest

from pbmpm.lab.loading import load_scene
from pbmpm.lab.simulation import RunSettings, Simulation

NAMES = ["glass_jelly", "water_wheel", "hourglass", "boat", "jelly_tower", "tiled_level"]


ENGINES = ["drink_3d", "raft_3d", "sandbox_3d"]


@pytest.mark.parametrize("name", [*(f"{name}_{dimension}d" for dimension in (2, 3) for name in NAMES), *ENGINES])
def test_a_sample_at_the_pace_of_a_game(root: Path, name: str) -> None:
    scene = load_scene(root / "samples" / "scenes" / f"{name}.json")
    settings = RunSettings.of(scene)
    assert (settings.rate_hz, settings.substeps, settings.iterations, settings.solver) == (60, 1, 5, "convergent")
    with Simulation(scene, settings) as simulation:
        for _ in range(60 if name.endswith("2d") else 6):
            simulation.step()
        simulation.stats()
        assert simulation.finite() and simulation.account()["missing"] == 0
        assert simulation.account()["deleted"] == 0


@pytest.mark.parametrize("script", ["samples/demo.sh", "tests/run.sh", "tests/long.sh"])
def test_scripts_name_the_argument_that_they_do_not_know(root: Path, script: str) -> None:
    """Before they install or build anything."""
    done = subprocess.run(["sh", root / script, "--pictres"], capture_output=True, text=True, timeout=60)
    name = Path(script).name
    assert (done.returncode, done.stdout, done.stderr) == (1, "", f"pbmpm: error: unknown argument '--pictres': {name} knows no arguments\n")


def test_the_jet_turns_the_wheel(root: Path) -> None:
    """Clockwise, and its rim no faster than water that falls from the emitter to its lowest point: sqrt(2^2 + 2 g 1.15) = 5.2 m/s."""
    scene = load_scene(root / "samples" / "scenes" / "water_wheel_2d.json")
    angles = []
    with Simulation(scene, RunSettings.of(scene)) as simulation:
        for _ in range(150):
            simulation.step()
            position, (_, _, z, w) = simulation.frame().body_poses[0]
            angles.append(2 * np.arctan2(z, w))
    assert position == [0, 0.75, 0]
    spin = np.diff(np.unwrap(angles))[-60:].mean() * 60
    assert -5.2 / 0.4 < spin < -1


def test_the_boat_floats(root: Path) -> None:
    scene = load_scene(root / "samples" / "scenes" / "boat_2d.json")
    with Simulation(scene, RunSettings.of(scene)) as simulation:
        for _ in range(180):
            simulation.step()
        height = simulation.frame().body_poses[1][0][1]
    assert -0.3 < height < 0.4  # of its waterline, in waves of 0.2 m
