"""What the present scene and settings will not hold, what would help, and what that costs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

from ._choice import Choice
from ._convert import shortest
from ._ffi import ffi
from ._library import lib
from ._member import WorldPart
from .settings import Integrator, Solver

if TYPE_CHECKING:
    from .world import World


class AdviceCode(Choice):
    """What an advice is about; `Advice.figure` and `Advice.bound` are of this."""

    NO_GRAVITY = ffi.integer_const("PBMPM_ADVICE_NO_GRAVITY")  #: nothing pulls
    FALLS_FOREVER = ffi.integer_const("PBMPM_ADVICE_FALLS_FOREVER")  #: share of the matter that has nothing below it
    IGNORED = ffi.integer_const("PBMPM_ADVICE_IGNORED")  #: a parameter that does nothing here, and its default
    POOL_TOO_DEEP = ffi.integer_const("PBMPM_ADVICE_POOL_TOO_DEEP")  #: g dt^2 depth / dx^2; with the paper's solver the strain at the bottom
    POOL_STIRS = ffi.integer_const("PBMPM_ADVICE_POOL_STIRS")  #: rms speed of a pool that does not come to rest [m/s]
    MODULUS_NOT_HELD = ffi.integer_const("PBMPM_ADVICE_MODULUS_NOT_HELD")  #: the Young modulus [Pa] that acts, and the material's own
    SAND_NOT_HELD = ffi.integer_const("PBMPM_ADVICE_SAND_NOT_HELD")  #: g dt^2 depth / dx^2 of sand, its mean strain, or cells per substep where it slides, lands or runs out; the text tells which
    BODY_TOO_THIN = ffi.integer_const("PBMPM_ADVICE_BODY_TOO_THIN")  #: thickness of a body [cells]
    BOUNCE_DAMPED = ffi.integer_const("PBMPM_ADVICE_BOUNCE_DAMPED")  #: substeps that a contact lasts
    ROLLING_BRAKED = ffi.integer_const("PBMPM_ADVICE_ROLLING_BRAKED")  #: half the width that a round body rests on [cells]
    COLLIDER_TOO_FAST = ffi.integer_const("PBMPM_ADVICE_COLLIDER_TOO_FAST")  #: an obstacle's way in the next substep [cells]
    COLLIDER_TOO_THIN = ffi.integer_const("PBMPM_ADVICE_COLLIDER_TOO_THIN")  #: thickness of an obstacle [cells]
    STEP_TOO_LONG = ffi.integer_const("PBMPM_ADVICE_STEP_TOO_LONG")  #: the longest way in a substep [cells]
    OVERLAPS = ffi.integer_const("PBMPM_ADVICE_OVERLAPS")  #: share of the matter that was put where there is other matter
    KNOWN_LIMIT = ffi.integer_const("PBMPM_ADVICE_KNOWN_LIMIT")  #: what neither rate nor iterations mend
    NO_FRICTION = ffi.integer_const("PBMPM_ADVICE_NO_FRICTION")  #: Coulomb coefficient of the domain's floor below sand; 0 of walls that a viscous liquid or a rigid body slips on
    EMITTER_OUTSIDE = ffi.integer_const("PBMPM_ADVICE_EMITTER_OUTSIDE")  #: how far beyond a wall of the domain an emitter stands [cells]
    EMITTER_REFUSED = ffi.integer_const("PBMPM_ADVICE_EMITTER_REFUSED")  #: came true: share of an emitter's particles that found no space
    COLLIDER_TOO_COARSE = ffi.integer_const("PBMPM_ADVICE_COLLIDER_TOO_COARSE")  #: width of a baked obstacle's grid cells [cells of the world]
    VOLUME_LOST = ffi.integer_const("PBMPM_ADVICE_VOLUME_LOST")  #: came true: share of the volume that is lost
    STRAIN_CLAMPED = ffi.integer_const("PBMPM_ADVICE_STRAIN_CLAMPED")  #: came true: share of particles at a bound of their strain
    NOT_SOLVED = ffi.integer_const("PBMPM_ADVICE_NOT_SOLVED")  #: came true: predicted error of the last substep [cells]


class Change(Choice):
    """What would help; `Advice.value` is to what."""

    NONE = ffi.integer_const("PBMPM_CHANGE_NONE")  #: nothing that a number says
    SUBSTEPS = ffi.integer_const("PBMPM_CHANGE_SUBSTEPS")  #: substeps, or the rate in the same proportion
    ITERATIONS = ffi.integer_const("PBMPM_CHANGE_ITERATIONS")  #: iterations
    CELL_SIZE = ffi.integer_const("PBMPM_CHANGE_CELL_SIZE")  #: cell size [m]
    SOLVER = ffi.integer_const("PBMPM_CHANGE_SOLVER")  #: solver
    GRAVITY = ffi.integer_const("PBMPM_CHANGE_GRAVITY")  #: gravity [m/s^2]
    KILL_BOUNDS = ffi.integer_const("PBMPM_CHANGE_KILL_BOUNDS")  #: kill bounds, or something to fall on
    PARAMETER = ffi.integer_const("PBMPM_CHANGE_PARAMETER")  #: the parameter, back to its default
    YOUNG_MODULUS = ffi.integer_const("PBMPM_CHANGE_YOUNG_MODULUS")  #: Young's modulus [Pa] of the material
    INTEGRATOR = ffi.integer_const("PBMPM_CHANGE_INTEGRATOR")  #: integrator
    COLLIDER = ffi.integer_const("PBMPM_CHANGE_COLLIDER")  #: thickness of the obstacle [m]
    BAKED_SPACING = ffi.integer_const("PBMPM_CHANGE_BAKED_SPACING")  #: width of the grid cells of the obstacle's baked solid [m]


_FEW = 64  # records that are asked for at first; there are seldom more

_UNITS = {Change.CELL_SIZE: " m", Change.GRAVITY: " m/s^2", Change.YOUNG_MODULUS: " Pa", Change.COLLIDER: " m thick", Change.BAKED_SPACING: " m"}


@dataclass(frozen=True)
class Advice:
    """One thing that the present scene and settings do not hold. ``str()`` makes a sentence of it, with the material or the obstacle that it is about.

    Attributes:
        code: what.
        text: the same in words.
        material: index of the material, as in `World.material_indices`; None: of no material.
        collider: identifier (index, generation) of the obstacle; None: of no obstacle.
        figure: what was found; `code` says of what.
        bound: what it would have to keep to.
        change: what would help.
        value: to what.
        price: what that costs, in percent of a step; None: not known.
        came_true: whether it was measured in the present state; else it is foreseen.
        kind: of the material or of the obstacle's shape, in a word ("sand", "box"); empty: of neither.
    """

    code: AdviceCode
    text: str
    material: int | None
    collider: tuple[int, int] | None
    figure: float
    bound: float
    change: Change
    value: float
    price: float | None
    came_true: bool
    kind: str = ""

    @property
    def unit(self) -> str:
        """Unit of `figure` and `bound`; empty where they have none."""
        return cast(bytes, ffi.string(lib.pbmpm_advice_unit(self.code.value))).decode()

    @property
    def _unit(self) -> str:
        return f" {self.unit}" if self.unit else ""

    @property
    def _wanted(self) -> str:
        if self.code is AdviceCode.IGNORED:
            return "default"
        return "should be at most" if self.figure >= self.bound else "should be at least"

    @property
    def remedy(self) -> str:
        """What would help, in words; empty if nothing that a number says."""
        if self.change is Change.NONE:
            return ""
        name = self.change.name.lower().replace("_", " ")
        if self.change is Change.KILL_BOUNDS:
            return "kill bounds, or an obstacle below"
        if self.change is Change.PARAMETER:
            return "leave it out"
        if self.change is Change.SOLVER:
            name += f" {Solver(int(self.value)).name.lower()}"
        elif self.change is Change.INTEGRATOR:
            name += f" {Integrator(int(self.value)).name.lower()}"
        else:
            name += f" {self.value:.3g}{_UNITS.get(self.change, '')}"
        if self.price is None:
            return f"{name} (at a price that is not known)"
        return f"{name} ({self.price:+.0f} % of a step)" if self.price else name

    @property
    def sentence(self) -> str:
        """The same as ``str()`` without whom it is about."""
        numbers = f" ({self.figure:.3g}{self._unit}; {self._wanted} {self.bound:.3g}{self._unit})" if self.figure or self.bound else ""
        remedy = f"; would help: {self.remedy}" if self.remedy else ""
        return f"{self.text}{numbers}{remedy}"

    @property
    def owner(self) -> str:
        """Whom it is about: a material or an obstacle by its kind and index; empty: the whole world."""
        if self.material is not None:
            return f"{self.kind or 'material'} {self.material}"
        return f"{self.kind} collider {self.collider[0]}".lstrip() if self.collider else ""

    def __str__(self) -> str:
        return f"{self.owner}: {self.sentence}" if self.owner else self.sentence


def _word(parameters: object) -> str:
    return type(parameters).__name__.lower()


def _advice_from_c(world: World, item: Any) -> Advice:
    kind = ""
    if item.material.generation:
        kind = next(_word(material.parameters) for material in world.materials if material.index == item.material.index)
    elif item.collider.generation:
        kind = next(_word(collider.shape) for collider in world.colliders if collider.identity[0] == item.collider.index)
    return Advice(
        code=AdviceCode(item.code),
        text=cast(bytes, ffi.string(item.text)).decode(),
        material=item.material.index if item.material.generation else None,
        collider=(item.collider.index, item.collider.generation) if item.collider.generation else None,
        figure=shortest(item.figure),
        bound=shortest(item.bound),
        change=Change(item.change),
        value=shortest(item.value),
        price=None if item.price < 0 else shortest(item.price),
        came_true=bool(item.came_true),
        kind=kind,
    )


class WorldAdvice(WorldPart):
    """What a `World` will not hold."""

    __slots__ = ()

    def advice(self: World, dt: float) -> list[Advice]:  # type: ignore[misc]
        """What the scene and settings of now will not hold when the world is stepped by `dt` [s], and what came true in the steps
        so far. Changes nothing; costs a few passes over the particles. An empty list is no promise."""
        count, size = ffi.new("uint32_t *"), _FEW
        while True:
            room = ffi.new("pbmpm_advice[]", size)
            room[0].size = ffi.sizeof("pbmpm_advice")
            self._call(lib.pbmpm_world_advice, dt, room, size, count)
            if count[0] <= size:
                break
            size = count[0]
        return [_advice_from_c(self, room[i]) for i in range(count[0])]
