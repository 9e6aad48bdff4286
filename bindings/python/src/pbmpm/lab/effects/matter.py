"""Effects of matter and of the solver: kinds of materials, their parameters, options of the solver."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, get_args

import numpy as np

from ..names import EffectName
from ..scenes.scene import MaterialPart, Scene, SleepingPart
from ..state import State
from .effect import Effect, NotHere, declared, never_idle, scene_with, undeclared

SHARE = 0.1
"""Of the particles that become a material which a scene does not have, to see what it would cost."""
PART_OF_KIND: dict[str, Any] = {
    get_args(part.model_fields["kind"].annotation)[0]: part for part in get_args(get_args(MaterialPart)[0])
}
"""The class of a scene for each kind of material."""
_DESCRIPTIONS: dict[str, str] = {
    "liquid": "matter that keeps its volume",
    "elastic": "matter that keeps its shape, with a deformation gradient per particle",
    "sand": "grains with friction",
    "visco": "matter that yields and flows",
}


def base_kind(scene: Scene) -> str:
    """The kind of material that the bare scene is made of: liquid if it has any, else that of its first source."""
    kinds = [scene.materials[source.material].kind for source in scene.sources]
    return "liquid" if "liquid" in kinds else kinds[0]


def materials_with_particles(scene: Scene) -> set[str]:
    """Names of the materials that something brings particles of."""
    return {source.material for source in scene.sources}


def kind_effect(kind: str) -> Effect:
    """A kind of material as an effect; switched off, its particles are of the base kind."""

    def found(scene: Scene) -> str | None:
        return next((f"materials.{name}" for name, part in scene.materials.items() if part.kind == kind), None)

    def idle(scene: Scene) -> str | None:
        present = {scene.materials[name].kind for name in materials_with_particles(scene)}
        return None if kind in present else "no fill or emitter brings particles of it"

    def off(scene: Scene, state: State) -> tuple[Scene, State]:
        base = base_kind(scene)
        if kind == base:
            raise NotHere("the bare scene is made of it")
        model = next(part for part in scene.materials.values() if part.kind == base)
        materials = {
            name: model.model_copy(update={"density": part.density}) if part.kind == kind else part
            for name, part in scene.materials.items()
        }
        return scene_with(scene, materials=materials), state

    def on(scene: Scene, state: State) -> tuple[Scene, State]:
        order = np.argsort(state.positions[:, 0], kind="stable")
        chosen = order[: max(1, round(SHARE * len(order)))]
        tried, materials, names = {}, dict(scene.materials), state.materials.astype(object)
        for name in set(names[chosen]):
            tried[name] = f"{name} as {kind}"
            materials[tried[name]] = PART_OF_KIND[kind](kind=kind, density=scene.materials[name].density)
        names[chosen] = [tried[name] for name in names[chosen]]
        return scene_with(scene, materials=materials), replace(state, materials=names)

    share = f"{100 * SHARE:g} % of the particles, those lowest along the first axis"
    return Effect(_name(kind), _DESCRIPTIONS[kind], share, found, idle, off, on)


def _name(kind: str) -> EffectName:
    return kind  # type: ignore[return-value]


def _of_flowing(
    name: EffectName, description: str, typical_value: float, works: Callable[[Scene], str | None], unit: str = "", matter: str = "liquid"
) -> Effect:
    """A parameter that is on where it is above 0, of the kinds of `matter` that have it. `works` tells why the solver does nothing with it."""

    def flowing(scene: Scene) -> dict[str, Any]:
        return {key: part for key, part in scene.materials.items() if hasattr(part, name)}

    def found(scene: Scene) -> str | None:
        return next((f"materials.{key}.{name}" for key, part in flowing(scene).items() if getattr(part, name) > 0), None)

    def idle(scene: Scene) -> str | None:
        if not any(getattr(part, name) > 0 for key, part in flowing(scene).items() if key in materials_with_particles(scene)):
            return f"no fill or emitter brings particles of {matter} with it"
        return works(scene)

    def changed(scene: Scene, value: float) -> Scene:
        if not flowing(scene).keys() & materials_with_particles(scene):
            raise NotHere(f"there is no {matter}")
        updated = {key: part.model_copy(update={name: value}) for key, part in flowing(scene).items()}
        return scene_with(scene, materials={**scene.materials, **updated})

    def off(scene: Scene, state: State) -> tuple[Scene, State]:
        return changed(scene, 0.0), state

    def on(scene: Scene, state: State) -> tuple[Scene, State]:
        if (problem := works(scene)) is not None:
            raise NotHere(problem)
        return changed(scene, typical_value), state

    return Effect(name, description, f"{typical_value:g}{unit} for all {matter}", found, idle, off, on)


def _paper_only(scene: Scene) -> str | None:
    return None if scene.solver.solver == "paper" else f"the {scene.solver.solver} solver does not use it"


def _solver_option(
    name: EffectName, description: str, field: str, plain: Any, typical: Any, works: Callable[[Scene], str | None]
) -> Effect:
    """An option of the solver that is on where it differs from `plain`."""

    def found(scene: Scene) -> str | None:
        return f"solver.{field}" if getattr(scene.solver, field) != plain else None

    def changed(scene: Scene, value: Any) -> Scene:
        return scene_with(scene, solver=scene.solver.model_copy(update={field: value}))

    def off(scene: Scene, state: State) -> tuple[Scene, State]:
        return changed(scene, plain), state

    def on(scene: Scene, state: State) -> tuple[Scene, State]:
        if (problem := works(scene)) is not None:
            raise NotHere(problem)
        return changed(scene, typical), state

    return Effect(name, description, f"{field} = {typical}", found, works, off, on)


def _has_liquid(scene: Scene) -> bool:
    return any(scene.materials[name].kind == "liquid" for name in materials_with_particles(scene))


def _has_solid(scene: Scene) -> bool:
    return any(scene.materials[name].kind not in ("liquid", "sand") for name in materials_with_particles(scene))


def _for_dual(scene: Scene) -> str | None:
    dual = scene.solver.solver == "dual" or (scene.solver.solver == "convergent" and _has_liquid(scene))
    if not dual:
        return "only the dual solver uses it"
    return None if _has_liquid(scene) else "there is no liquid"


def _for_flip(scene: Scene) -> str | None:
    if scene.solver.solver == "paper":
        return "the paper's solver does not use it"
    sources = [scene.materials[name] for name in materials_with_particles(scene)]
    thin = any(part.kind == "liquid" and part.kinematic_viscosity == 0 for part in sources)
    return None if thin else "there is no liquid without viscosity"


def _for_primal(scene: Scene) -> str | None:
    solver = scene.solver.solver
    primal = solver == "primal" or (solver == "convergent" and _has_solid(scene))
    return None if primal else "only the primal solver uses it"


def _sleeping_found(scene: Scene) -> str | None:
    if scene.sleeping is not None:
        return "sleeping"
    return "effects" if declared(scene, "sleeping") else None


def _sleeping_off(scene: Scene, state: State) -> tuple[Scene, State]:
    return scene_with(undeclared(scene, "sleeping"), sleeping=None), state


def _sleeping_on(scene: Scene, state: State) -> tuple[Scene, State]:
    return scene_with(scene, sleeping=SleepingPart()), state


def matter_effects() -> list[Effect]:
    """In the order of reports."""
    return [
        *(kind_effect(kind) for kind in PART_OF_KIND),
        _of_flowing("viscosity", "liquids lose a share of their strain rate per iteration", 0.01, _paper_only),
        _of_flowing("kinematic_viscosity", "liquids of a physical viscosity", 1e-3, never_idle, " m^2/s"),
        _of_flowing("volume_feedback", "what flows follows the volume that the grid sees", 0.1, never_idle, matter="liquid or visco"),
        _solver_option(
            "pressure_in_cells", "one pressure per cell: livelier liquids", "pressure", "particles", "cells", _for_dual
        ),
        _solver_option("flip", "liquids keep motion finer than the grid", "flip", 0.0, 0.9, _for_flip),
        _solver_option("bdf2", "second order in time", "integrator", "euler", "bdf2", _for_primal),
        Effect(
            "sleeping",
            "matter at rest takes no part in steps",
            "all that is at rest sleeps already",
            _sleeping_found,
            never_idle,
            _sleeping_off,
            _sleeping_on,
        ),
    ]
