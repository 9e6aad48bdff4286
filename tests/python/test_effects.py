"""Effects of scenes: which are there, what they cost, and the advice that follows."""

from __future__ import annotations

import copy
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from pbmpm.lab.effects.advice import advice_of, advice_text
from pbmpm.lab.effects.catalogue import EFFECTS, effects_on, presences, remarks
from pbmpm.lab.effects.cost_chart import save_chart
from pbmpm.lab.effects.effect import Effect, NotHere
from pbmpm.lab.effects.hosting import HOST_EFFECTS
from pbmpm.lab.effects.measure import BARE, Plan, bare, cost_of, measure, names, settled
from pbmpm.lab.effects.probe import Comparison, Probe, compare, comparison_of
from pbmpm.lab.effects.report import report_of, text_of, whole
from pbmpm.lab.errors import InputError
from pbmpm.lab.parsing import parse_scene
from pbmpm.lab.scenes.scene import Scene
from pbmpm.lab.simulation import RunSettings, Simulation
from pbmpm.lab.state import state_of

from progress_lines import without_progress
from test_scene_run import pbmpm_command

WATER: dict[str, Any] = {
    "format": "pbmpm-scene",
    "version": 1,
    "name": "water",
    "dimension": 2,
    "cell_size": 0.1,
    "gravity": [0, -9.81],
    "domain": {"min": [0, 0], "max": [2, 1.5]},
    "seconds": 0.5,
    "iterations": 3,
    "solver": {"solver": "paper"},
    "materials": {"water": {"kind": "liquid", "volume_feedback": 0}},
    "fills": [{"shape": {"kind": "box", "position": [0.5, 0.3], "half_extents": [0.5, 0.3]}, "material": "water"}],
}
SQUARE = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]]
BALL = {"kind": "sphere", "position": [0.6, 0.3], "radius": 0.1}
PATH = {"keyframes": [{"time": 0, "position": [1.2, 0.2]}, {"time": 0.5, "position": [0.8, 0.2]}]}
FORCES = ("uniform", "radial", "vortex", "drag", "grab")


def crowded() -> dict[str, Any]:
    """A scene with an effect of every sort but options of solvers."""
    data = copy.deepcopy(WATER)
    data["materials"]["water"] |= {"viscosity": 0.01, "volume_feedback": 0.1}
    data["materials"]["jelly"] = {"kind": "elastic"}
    data["fills"].append({"shape": {"kind": "sphere", "position": [1.6, 0.4], "radius": 0.2}, "material": "jelly"})
    data["emitters"] = [{"shape": {"kind": "sphere", "position": [1, 1.2], "radius": 0.1}, "material": "water", "rate": 0.1}]
    data["drains"] = [{"shape": {"kind": "sphere", "position": [0.1, 0], "radius": 0.1}}]
    data["kill_bounds"] = {"min": [0, 0], "max": [2, 1.4]}
    data["forces"] = [{"kind": kind, "strength": 0.1, "shape": BALL} for kind in FORCES]
    data["colliders"] = [
        {"shape": {"kind": "mesh", "position": [0.3, 0.3], "vertices": SQUARE, "hull": True, "resolution": 8}},
        {"shape": BALL | {"position": [1.2, 0.2]}, "motion": PATH},
        {"shape": {"kind": "box", "position": [1.0, 0.6], "half_extents": [0.1, 0.1]}, "body": {"mass": 5}},
        {"shape": {"kind": "plane", "position": [0, 0.05], "normal": [0, 1]}},
    ]
    return data


CROWDED_ON = [
    *("liquid", "elastic", "viscosity", "volume_feedback", "emitters", "drains", "kill_bounds"),
    *(f"{kind}_force" for kind in FORCES),
    *("rigid_bodies", "moving_obstacles", "baked_solids", "obstacles"),
]


def water_3d() -> dict[str, Any]:
    data = copy.deepcopy(WATER) | {"dimension": 3, "gravity": [0, -9.81, 0]}
    data["domain"] = {"min": [0, 0, 0], "max": [2, 1.5, 1]}
    data["fills"][0]["shape"] = {"kind": "box", "position": [0.5, 0.3, 0.5], "half_extents": [0.5, 0.3, 0.5]}
    return data


def effect_of(name: str) -> Effect:
    return next(effect for effect in EFFECTS if effect.name == name)


def run_to(scene: Scene, steps: int) -> Any:
    with Simulation(scene, RunSettings.of(scene, 1)) as simulation:
        for _ in range(steps):
            simulation.step()
        return state_of(simulation)


# Which effects a scene has


def test_effects_follow_from_what_is_in_a_scene() -> None:
    assert effects_on(parse_scene(WATER)) == ["liquid"]
    assert sorted(effects_on(parse_scene(crowded()))) == sorted(CROWDED_ON)
    assert remarks(parse_scene(crowded())) == []


@pytest.mark.parametrize(
    ("solver", "on", "idle"),
    [
        ({"solver": "dual", "pressure": "cells", "flip": 0.5}, ["liquid", "pressure_in_cells", "flip"], []),
        ({"solver": "paper", "flip": 0.5}, ["liquid", "flip"], ["flip"]),
        ({"solver": "dual", "integrator": "bdf2"}, ["liquid", "bdf2"], ["bdf2"]),
        ({"solver": "primal", "integrator": "bdf2"}, ["liquid", "bdf2"], []),
        ({"solver": "convergent", "pressure": "cells"}, ["liquid", "pressure_in_cells"], []),
    ],
)
def test_options_of_the_solver_are_effects(solver: dict[str, Any], on: list[str], idle: list[str]) -> None:
    found = presences(parse_scene(WATER | {"solver": solver}))
    assert [item.effect.name for item in found if item.on] == on
    assert [item.effect.name for item in found if item.idle] == idle


def _changed(change: dict[str, Any]) -> Scene:
    data = copy.deepcopy(WATER)
    data["materials"] |= change.pop("materials", {})
    return parse_scene(data | change)


@pytest.mark.parametrize(
    ("name", "change", "why"),
    [
        ("elastic", {"materials": {"jelly": {"kind": "elastic"}}}, "no fill or emitter"),
        ("volume_feedback", {"materials": {"oil": {"kind": "liquid"}}}, "no fill or emitter"),
        ("flip", {"solver": {"solver": "paper", "flip": 0.5}}, "paper's solver"),
        ("emitters", {"emitters": [{"shape": BALL, "material": "water", "rate": 0}]}, "rate is 0"),
        ("emitters", {"emitters": [{"shape": BALL, "material": "water", "rate": 1, "start": 0.5}]}, "after the end"),
        ("drains", {"drains": [{"shape": BALL, "start": 9}]}, "after the end"),
        ("kill_bounds", {"kill_bounds": {"min": [-1, -1], "max": [3, 3]}}, "walls of the domain"),
        ("drag_force", {"forces": [{"kind": "drag", "strength": 0}]}, "strength is 0"),
        ("obstacles", {"colliders": [{"shape": BALL | {"position": [3, 3]}}]}, "outside of the domain"),
        (
            "moving_obstacles",
            {"colliders": [{"shape": BALL, "motion": {"keyframes": [{"time": t, "position": [1, 1]} for t in (0, 1)]}}]},
            "poses are the same",
        ),
    ],
)
def test_what_is_on_and_does_nothing_is_named(name: str, change: dict[str, Any], why: str) -> None:
    scene = _changed(copy.deepcopy(change))
    item = next(item for item in presences(scene) if item.effect.name == name)
    assert item.on and not item.called_for
    assert why in (item.idle or "")
    assert any(f"'{name}'" in said and why in said for said in remarks(scene))


def test_a_grab_of_no_strength_still_grabs() -> None:
    scene = parse_scene(WATER | {"forces": [{"kind": "grab", "strength": 0, "shape": BALL}]})
    assert remarks(scene) == []


@pytest.mark.parametrize("name", CROWDED_ON)
def test_a_declared_list_must_name_everything(name: str) -> None:
    data = crowded() | {"effects": [word for word in CROWDED_ON if word != name]}
    with pytest.raises(InputError, match=rf"^scene: effects: '{name}' is missing, but [a-z_.\[\]0-9]+ needs it$"):
        parse_scene(data)
    assert parse_scene(crowded() | {"effects": CROWDED_ON}).effects == CROWDED_ON


def test_declared_and_not_there_is_reported() -> None:
    scene = parse_scene(WATER | {"effects": ["liquid", "drains"]})
    assert effects_on(scene) == ["liquid"]
    assert remarks(scene) == ["effect 'drains' is declared, but nothing in the scene uses it; it stays off"]
    with pytest.raises(InputError, match=r"effects\[0\]"):
        parse_scene(WATER | {"effects": ["lava"]})


def test_declared_impulses_are_measured() -> None:
    data = WATER | {"colliders": [{"shape": {"kind": "plane", "position": [0, 0.1], "normal": [0, 1]}}]}
    for effects in (None, ["liquid", "obstacles", "impulses"]):
        scene = parse_scene(data | {"effects": effects})
        with Simulation(scene, RunSettings.of(scene, 1)) as simulation:
            simulation.step()
            assert simulation.colliders[0].measures_impulse is (effects is not None)
            if effects is not None:
                assert simulation.world.wall_impulse(0) is not None
        assert ("impulses" in effects_on(scene)) is (effects is not None)


@pytest.mark.parametrize(
    ("change", "settings"),
    [
        ({}, (False, 0.05, 0.5)),
        ({"effects": ["liquid", "sleeping"]}, (True, 0.05, 0.5)),
        ({"sleeping": {"speed": 0.25, "time": 1}}, (True, 0.25, 1.0)),
    ],
)
def test_a_scene_can_sleep(change: dict[str, Any], settings: tuple[bool, float, float]) -> None:
    scene = parse_scene(WATER | change)
    assert effects_on(scene) == (["liquid", "sleeping"] if settings[0] else ["liquid"])
    with Simulation(scene, RunSettings.of(scene, 1)) as simulation:
        world = simulation.world
        assert (world.sleeping, world.sleep_speed, world.sleep_time) == settings
    off, _ = effect_of("sleeping").off(scene, run_to(scene, 1))
    assert effects_on(off) == ["liquid"]


def test_a_probe_of_a_scene_that_sleeps_begins_with_what_is_at_rest_asleep() -> None:
    data = copy.deepcopy(WATER) | {"sleeping": {"speed": 1.0}}
    data["fills"][0]["shape"] = {"kind": "box", "position": [1, 0.3], "half_extents": [1, 0.3]}
    scene = parse_scene(data)
    state = run_to(scene, 1)
    with Probe(scene, RunSettings.of(scene, 1), state, len(state)) as probe:
        assert probe.world.stats.particles_asleep == len(state)
        assert probe.world.sleep_time == 0.5


# Switching


def test_the_bare_scene_has_no_effect_left() -> None:
    scene = parse_scene(crowded())
    state = run_to(scene, 3)
    plain, same = bare(scene, state, presences(scene))
    assert effects_on(plain) == ["liquid"] and len(same) == len(state)
    assert {part.density for part in plain.materials.values()} == {1000.0}
    with Simulation(plain, RunSettings.of(plain, 1), same, len(same)) as simulation:
        simulation.step()
        assert len(simulation.world) == len(state)
        assert simulation.world.stats.mass == pytest.approx(float(1000 * np.sum(state.rest_volumes)), rel=1e-6)


@pytest.mark.parametrize("name", [name for name in CROWDED_ON if name != "liquid"])
def test_an_effect_is_switched_off_alone(name: str) -> None:
    scene = parse_scene(crowded())
    state = run_to(scene, 2)
    less, same = effect_of(name).off(scene, state)
    gone = set(effects_on(scene)) - set(effects_on(less))
    assert name in gone and gone <= {name, "rigid_bodies", "moving_obstacles"}  # plain obstacles go with their motions
    with Simulation(less, RunSettings.of(less, 1), same, 2 * len(same)) as simulation:
        simulation.step()
        assert simulation.finite()


@pytest.mark.parametrize(("name", "index"), [("moving_obstacles", 1), ("rigid_bodies", 2)])
def test_what_moved_stands_still_where_it_is(name: str, index: int) -> None:
    scene = parse_scene(crowded())
    state = run_to(scene, 12)
    less, _ = effect_of(name).off(scene, state)
    assert len(less.colliders) == len(scene.colliders)
    with Simulation(scene, RunSettings.of(scene, 1), state, 2 * len(state)) as simulation:
        expected = simulation.colliders[index].shape
    part = less.colliders[index]
    assert part.motion is None and part.body is None
    assert part.shape.position == pytest.approx(expected.position, abs=1e-6)
    assert part.shape.position != pytest.approx(scene.colliders[index].shape.position, abs=1e-3)


@pytest.mark.parametrize("data", [WATER, water_3d()], ids=["2D", "3D"])
@pytest.mark.parametrize("solver", ["paper", "dual", "primal"])
def test_every_effect_can_be_tried(data: dict[str, Any], solver: str) -> None:
    """Each effect is on in the scene that it is tried in and that scene runs, or there is a reason why it cannot be."""
    scene = parse_scene(data | {"solver": {"solver": solver}, "iterations": 1})
    state = run_to(scene, 1)
    refused = {}
    for effect in EFFECTS:
        if effect.name == "liquid":
            continue
        try:
            more, changed = effect.on(scene, state)
        except NotHere as why:
            refused[effect.name] = str(why)
            continue
        item = next(item for item in presences(more) if item.effect is effect)
        assert item.on, effect.name
        if effect.name not in ("elastic", "sand", "visco", "kill_bounds"):  # put into the state, without a fill; or far away
            assert item.idle is None, effect.name
        with Simulation(more, RunSettings.of(more, 1), changed, 2 * len(state)) as simulation:
            for _ in range(2):
                simulation.step()
            assert simulation.finite() and len(simulation.world) > 0
    expected = {
        "paper": {"pressure_in_cells", "flip", "bdf2"},
        "dual": {"viscosity", "bdf2"},
        "primal": {"viscosity", "pressure_in_cells"},
    }
    assert refused.keys() == expected[solver]


def test_a_tenth_of_the_matter_is_tried_as_another_kind() -> None:
    scene = parse_scene(WATER)
    state = run_to(scene, 1)
    more, changed = effect_of("elastic").on(scene, state)
    tried = changed.materials != "water"
    assert tried.sum() == round(0.1 * len(state))
    assert state.positions[tried, 0].max() <= state.positions[~tried, 0].min()
    assert more.materials["water as elastic"].density == 1000


# States and probes


def test_a_state_goes_into_another_world_as_it_is() -> None:
    data = crowded()
    data["emitters"] = []
    scene = parse_scene(data)
    state = run_to(scene, 10)
    with Simulation(scene, RunSettings.of(scene, 1), state, len(state)) as simulation:
        again = state_of(simulation)
    for field in ("positions", "velocities", "affine_velocities", "deformations", "materials"):
        assert np.array_equal(getattr(state, field), getattr(again, field)), field
    assert again.rest_volumes == pytest.approx(state.rest_volumes, rel=1e-6)
    liquid = state.materials == "water"
    assert np.array_equal(state.volume_ratios[liquid], again.volume_ratios[liquid])
    assert (again.steps, again.time) == (10, pytest.approx(10 / 60))
    assert again.bodies[0]["pose"] == state.bodies[0]["pose"]


@pytest.mark.parametrize("host", [None, *HOST_EFFECTS], ids=lambda host: host.name if host else "none")
def test_turns_repeat_bit_for_bit(host: Any) -> None:
    scene = parse_scene(crowded())
    state = run_to(scene, 5)
    with Probe(scene, RunSettings.of(scene, 1), state, 2 * len(state), host) as probe:
        hashes = []
        for _ in range(2):
            assert probe.turn(4) > 0
            hashes.append((probe.world.hash(), probe.steps, len(probe.world), str(probe.body_states())))
        assert hashes[0] == hashes[1]
        probe.step()
        assert probe.world.hash() != hashes[0][0]


def test_turns_alternate() -> None:
    order: list[str] = []

    def turn(name: str, seconds: float) -> Any:
        return lambda steps: (order.append(name), steps * seconds)[1]

    comparison = compare(turn("a", 2.0), turn("b", 3.0), 5, 3)
    assert order == ["a", "b", "b", "a", "a", "b"]
    assert comparison == Comparison(1.5, 0.0, 2.0, 3)


def test_the_median_of_ratios_forgives_a_disturbed_turn() -> None:
    times = np.array([[1.0, 1.2], [2.0, 2.4], [1.0, 1.2], [1.0, 50.0], [0.5, 0.6]])
    comparison = comparison_of(times, 10)
    assert comparison.ratio == pytest.approx(1.2)
    assert comparison.seconds == pytest.approx(0.1)
    noisy = comparison_of(1.0 + np.array([[0.0, x] for x in (0.0, 0.1, 0.2, 0.3, 0.4)]), 1)
    # quartiles 1.1 and 1.3: 1.2533 * 0.7413 * 0.2 / sqrt(5)
    assert noisy.error == pytest.approx(0.93 * 0.2 / math.sqrt(5), rel=1e-3)


# Costs


def test_costs_are_shares_of_the_scene_as_it_is() -> None:
    """An effect without which a step takes 0.8 of 50 ns costs 10 ns; one with which it takes 1.3 of them would cost 15 ns."""
    on = cost_of("drains", True, Comparison(0.8, 0.01, 1e-3, 9), -16.0, 50.0, {})
    off = cost_of("flip", False, Comparison(1.3, 0.02, 1e-3, 9), 4.0, 50.0, {})
    assert on.as_row() == pytest.approx(
        {
            "effect": "drains",
            "on": True,
            "ns_per_particle_step": 10.0,
            "percent_of_step": 20.0,
            "bytes_per_particle": 16.0,
            "percent_error": 1.0,
            "samples": 9,
        }
    )
    assert (off.nanoseconds, off.percent, off.bytes_per_particle) == pytest.approx((15.0, 30.0, 4.0))


@pytest.fixture(scope="module")
def measured() -> Any:
    scene = parse_scene(crowded() | {"effects": [*CROWDED_ON, "flip"]})
    return measure(scene, RunSettings.of(scene, 1), Plan(at=0.1, rounds=3))


def test_rows_and_their_sum(measured: Any) -> None:
    report = report_of(measured)
    rows = {row["effect"]: row for row in report["rows"]}
    assert list(rows)[0] == BARE
    assert rows.keys() | report["left_out"].keys() == {BARE, *names()}
    assert set(report["left_out"]) == {"liquid", "pressure_in_cells", "flip", "bdf2"}
    for row in rows.values():
        assert {"effect", "on", "ns_per_particle_step", "percent_of_step", "bytes_per_particle"} <= row.keys()
        assert row["ns_per_particle_step"] == pytest.approx(row["percent_of_step"] / 100 * measured.nanoseconds)
    on = [row for row in rows.values() if row["on"]]
    assert {row["effect"] for row in on} == {BARE, *CROWDED_ON} - {"liquid"}
    total = sum(row["ns_per_particle_step"] for row in on) + report["interplay_ns_per_particle_step"]
    assert total == pytest.approx(report["scene_ns_per_particle_step"])
    assert rows[BARE]["ns_per_particle_step"] > 0
    control = abs(report["control_percent_of_step"])
    assert all(row["percent_error"] >= control for row in rows.values())


def test_memory_of_effects(measured: Any) -> None:
    """F takes 16 bytes per particle in 2D; parameters that only change numbers take none; a snapshot is the host's."""
    rows = {cost.effect: cost for cost in measured.costs}
    assert rows["elastic"].bytes_per_particle >= 16
    assert rows["viscosity"].bytes_per_particle == rows["statistics"].bytes_per_particle == 0
    assert rows["snapshots"].bytes_per_particle >= 76  # what snapshot.h says
    assert 0 < rows[BARE].bytes_per_particle < measured.bytes_per_particle


def test_report_text_and_chart(measured: Any, tmp_path: Path) -> None:
    report = report_of(measured)
    text = text_of(report)
    for said in (*CROWDED_ON, "interplay", "not measured: liquid", "'flip' is declared", "the scene calls for: liquid, elastic"):
        assert said in text
    save_chart(report, tmp_path / "sub" / "chart.png")
    with Image.open(tmp_path / "sub" / "chart.png") as image:
        assert image.format == "PNG" and len(image.convert("RGB").getcolors(1 << 20)) > 10


def test_less_than_half_a_byte_is_none() -> None:
    assert [whole(value) for value in (-0.4, -0.0, 0.4, 15.6, -3.2)] == ["0", "0", "0", "16", "-3"]


def test_a_scene_without_matter_cannot_be_measured() -> None:
    data = copy.deepcopy(WATER) | {"fills": [], "emitters": [{"shape": BALL, "material": "water", "rate": 1, "start": 0.4}]}
    scene = parse_scene(data)
    with pytest.raises(InputError, match="no particle after 0.1 s"):
        settled(scene, RunSettings.of(scene, 1), 0.1)


# Advice


def row(effect: str, on: bool, percent: float, **more: Any) -> dict[str, Any]:
    plain = {"called_for": on, "idle": None, "percent_error": 1.0, "bytes_per_particle": 0.0}
    return {"effect": effect, "on": on, "percent_of_step": percent, **plain, **more}


def test_advice() -> None:
    rows = [
        row("emitters", True, 5.0),
        row("elastic", True, 8.0, called_for=False, idle="no particles", bytes_per_particle=16.0),
        row("drains", True, 1.5, called_for=False, idle="too late"),
        row("flip", False, 4.0),
        row("queries", False, 20.0, bytes_per_particle=2.0),
        row("kill_bounds", False, 1.9),
        row("sleeping", False, -30.0, bytes_per_particle=-3.0),
    ]
    advice = advice_of(["liquid", "emitters"], rows)
    assert advice["calls_for"] == ["liquid", "emitters"]
    assert advice["leave_out"] == [
        {"effect": "elastic", "why": "no particles", "saves_percent": 8.0, "saves_bytes_per_particle": 16.0},
        {"effect": "drains", "why": "too late", "saves_percent": 0.0, "saves_bytes_per_particle": 0.0},
    ]
    assert advice["leave_out_saves_percent"] == 8.0
    assert advice["off"] == ["flip", "queries", "kill_bounds", "sleeping"]
    assert (advice["off_saves_percent"], advice["off_saves_bytes_per_particle"]) == (24.0, 2.0)
    text = advice_text(advice)
    assert "calls for: liquid, emitters" in text and "leave out elastic: no particles; saves 8.0 %" in text
    assert "none of the 3 effects that are on and were measured costs accuracy" in text
    assert "the 4 effects that are off cost nothing; together they would cost 24 % of a step" in text


def test_advice_names_what_costs_accuracy() -> None:
    """Only what is on, and only what grows by more than a hundredth and a tenth."""
    worse = {"predicted_error_with": 0.05, "predicted_error_without": 0.02, "volume_error_with": 0.03, "volume_error_without": 0.03}
    alike = {"predicted_error_with": 1.05, "predicted_error_without": 1.0, "volume_error_with": 0.2, "volume_error_without": 0.1}
    advice = advice_of(["flip"], [row("flip", True, 4.0, **worse), row("elastic", True, 1.0, **alike), row("bdf2", False, 1.0, **worse)])
    assert [(hurt["effect"], hurt["error"]) for hurt in advice["hurts_accuracy"]] == [("flip", "predicted_error"), ("elastic", "volume_error")]
    text = advice_text(advice)
    assert "flip costs accuracy: predicted error 0.05 cells, without it 0.02 cells" in text
    assert "elastic costs accuracy: volume error 20 %, without it 10 %" in text and "none of the" not in text


@pytest.mark.parametrize(
    ("on", "off", "said"),
    [
        (0, 1, "accuracy: no effect that is on was measured\nthe effect that is off costs nothing; it would cost 4 % of a step"),
        (1, 0, "the effect that was measured costs no accuracy"),
        (2, 0, "none of the 2 effects that are on and were measured costs accuracy"),
    ],
)
def test_advice_speaks_of_what_was_measured(on: int, off: int, said: str) -> None:
    rows = [row("flip", True, 4.0)] * on + [row("queries", False, 4.0)] * off
    assert said in advice_text(advice_of(["liquid"], rows))


# The command


def test_command(tmp_path: Path) -> None:
    (tmp_path / "scene.json").write_text(json.dumps(WATER))
    options = ("--rounds", 3, "--at", 0.05, "--only", "elastic,statistics")
    done = pbmpm_command("effects", "scene.json", *options, "--json", "-", "--chart", "chart.png", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert without_progress(done.stderr) == []
    report = json.loads(done.stdout)
    assert [row["effect"] for row in report["rows"]] == [BARE, "elastic", "statistics"]
    assert [row["on"] for row in report["rows"]] == [True, False, False]
    assert report["rows"][1]["volume_error_without"] > 0.0 and report["rows"][1]["predicted_error_with"] >= 0.0
    assert (report["scene"], report["particles"], report["rounds"]) == ("water", 240, 3)
    assert (tmp_path / "chart.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("effects", "scene.json", "--only", "lava"), "'lava' is not one of liquid"),
        (("effects", "scene.json", "--rounds", "1"), "--rounds"),
        (("effects", "declared.json"), "declared.json: effects: 'liquid' is missing, but materials.water needs it"),
        (("run", "declared.json"), "effects: 'liquid' is missing"),
    ],
)
def test_bad_input_is_exit_code_2(tmp_path: Path, arguments: tuple[str, ...], said: str) -> None:
    (tmp_path / "scene.json").write_text(json.dumps(WATER))
    (tmp_path / "declared.json").write_text(json.dumps(WATER | {"effects": ["emitters"]}))
    done = pbmpm_command(*arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert said in done.stderr and "Traceback" not in done.stderr


def test_a_scene_that_breaks_is_exit_code_1(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from click.testing import CliRunner

    from pbmpm.lab.commands.cli import cli

    (tmp_path / "scene.json").write_text(json.dumps(WATER))
    monkeypatch.setattr(Simulation, "problems", lambda self: ["7 particles are gone"])
    done = CliRunner().invoke(cli, ["effects", str(tmp_path / "scene.json"), "--at", "0.02"])
    assert done.exit_code == 1
    assert "7 particles are gone" in done.output


def test_run_prints_what_is_on_and_the_account(tmp_path: Path) -> None:
    (tmp_path / "scene.json").write_text(json.dumps(crowded() | {"effects": [*CROWDED_ON, "flip"]}))
    done = pbmpm_command("run", tmp_path / "scene.json", "--json", "-")
    assert done.returncode == 0, done.stderr
    report = json.loads(done.stdout)
    assert sorted(report["effects"]) == sorted(CROWDED_ON)
    assert "note: effect 'flip' is declared" in done.stderr and any("flip" in said for said in report["effect_remarks"])
    account = report["account"]
    assert account["emitted"] > 0 and account["drained"] > 0 and account["missing"] == 0
    came = account["start"] + account["emitted"]
    assert came - account["drained"] - account["killed"] - account["deleted"] == account["now"] == report["particles"]
    text = pbmpm_command("run", tmp_path / "scene.json").stdout
    assert f"= {account['now']} now" in text and "effects: liquid, elastic, " in text


def test_missing_mass_fails_the_run() -> None:
    scene = parse_scene(WATER)
    with Simulation(scene, RunSettings.of(scene, 1)) as simulation:
        simulation.step()
        assert simulation.problems() == [] and simulation.account()["missing_mass"] == pytest.approx(0, abs=1e-9)
        simulation.start_mass *= 1 + 1e-9
        assert ["kg are gone" in said for said in simulation.problems()] == [True]


