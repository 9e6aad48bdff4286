"""Which settings a sweep tries, and the one that all are compared with."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from ..scenes.scene import Scene
from ..simulation import RunSettings

SUBSTEPS = (1, 2, 4, 8)
ITERATIONS = (1, 2, 5, 10, 20, 50)
#: Predicted errors [cells] at which iterations may end, and the most iterations then.
TARGET_ERRORS = (0.1, 0.01)
TARGET_ITERATIONS = 100
EXPLICIT_SUBSTEPS = (1, 2, 4, 8, 16, 32)
REFERENCE_SUBSTEPS = 16
REFERENCE_ITERATIONS = 100


@dataclass(frozen=True)
class Kinds:
    """What a scene is made of, as far as solvers care."""

    liquid: bool
    elastic: bool
    incompressible: bool  #: a liquid without a bulk modulus

    @classmethod
    def of(cls, scene: Scene) -> Kinds:
        used = [scene.materials[fill.material] for fill in scene.sources]
        liquids = [part for part in used if part.kind == "liquid"]
        return cls(bool(liquids), len(liquids) < len(used), any(part.bulk_modulus == 0.0 for part in liquids))


def reference(scene: Scene, frame_rate: float, threads: int, substeps: int, iterations: int) -> RunSettings:
    """The scene's own materials, solved as well as it goes: many substeps and iterations of the solver that converges.

    How the pressure is kept and how lively the liquid is stay as the scene says: they are choices, not errors. Elastic
    bodies alone are integrated with second order.
    """
    kinds = Kinds.of(scene)
    return RunSettings.of(
        scene,
        threads,
        rate_hz=frame_rate,
        substeps=substeps,
        iterations=iterations,
        solver=_methods(kinds)[0][0],
        integrator="euler" if kinds.liquid else "bdf2",
        target_error=0.0,
        time_budget_ms=0.0,
    )


def candidates(scene: Scene, frame_rate: float, threads: int) -> list[RunSettings]:
    """All settings of a sweep; of one solver and substep count, those with more iterations come later."""
    plain = RunSettings.of(scene, threads, rate_hz=frame_rate, target_error=0.0, time_budget_ms=0.0)
    return [replace(plain, **changes) for changes in _changes(Kinds.of(scene))]


def _changes(kinds: Kinds) -> Iterator[dict[str, Any]]:
    for solver, integrator in _methods(kinds):
        for substeps in SUBSTEPS:
            fixed = {"solver": solver, "integrator": integrator, "substeps": substeps}
            for iterations in ITERATIONS:
                yield {**fixed, "iterations": iterations}
            for target in TARGET_ERRORS if solver != "paper" else ():
                yield {**fixed, "iterations": TARGET_ITERATIONS, "target_error": target}
    if not kinds.incompressible:
        for substeps in EXPLICIT_SUBSTEPS:
            yield {"solver": "explicit", "integrator": "euler", "substeps": substeps, "iterations": 1}


def _methods(kinds: Kinds) -> list[tuple[str, str]]:
    if kinds.liquid and kinds.elastic:
        return [("convergent", "euler"), ("dual", "euler"), ("paper", "euler")]
    if kinds.liquid:
        return [("dual", "euler"), ("paper", "euler")]
    return [("primal", "euler"), ("primal", "bdf2"), ("paper", "euler")]


def left_out(scene: Scene) -> list[str]:
    """What a sweep of this scene does not try, and why."""
    kinds = Kinds.of(scene)
    said = []
    if kinds.incompressible:
        said.append("explicit solver: the liquid has no bulk modulus")
    if kinds.liquid:
        said.append("primal solver: the scene holds a liquid" + (", which the convergent solver has it solve with the bodies" if kinds.elastic else ""))
        said.append("other pressure and flip settings: they change the motion and are the scene's to choose")
    else:
        said.append("dual solver: for elastic bodies alone the primal one converges faster")
    return said
