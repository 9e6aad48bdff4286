"""Random closed scenes that once gained energy: tests/random_scenes.py draws them from these seeds."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

SCENES = runpy.run_path(str(Path(__file__).parents[1] / "random_scenes.py"))


@pytest.mark.parametrize("seed", [12701, 20452, 21652, 21704, 23000, 56528, 57117, 58556, 58935, 62488, 71200, 83700, 95978, 180429, 193188, 194653])
def test_no_scene_gains_energy(seed: int) -> None:
    """Solids in liquid at walls that few iterations leave unfinished: most gained 3 to 45 % before the momentum of bodies was balanced.

    56528, 95978: heavy water tore light clay, a stiff body hit heavy water, and nobody asked what their motion kept. 57117: liquid that bore nothing pressed while it
    grew. 58556: the dual was left a stiff block that it does not hold. 20452, 58935, 193188, 194653: stresses of sand that few iterations left pushed it.
    180429: a first form of their bound crushed sand into the floor, by 270 times its energy. 62488, 71200, 83700 (the paper's solver): without gravity, volume feedback pressed against the noise of a filling.
    """
    result = SCENES["run"](seed)
    assert result["whole"]
    assert result["gain"] <= SCENES["ALLOWED"], result["setting"]
