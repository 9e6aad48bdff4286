"""Settings of a world: what may change between steps."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from ._choice import Choice
from ._convert import Vector, initialised, plain, shortest, sized
from ._ffi import ffi
from ._library import lib
from ._member import WorldPart
from ._setters import axes, choice, flag, number
from .shapes import Shape, to_c


class Solver(Choice):
    """How the equations of a substep are solved."""

    #: the paper's; its stiffness follows from iterations and dt
    PAPER = ffi.integer_const("PBMPM_SOLVER_PAPER")
    #: backward Euler with the materials' moduli, one stress per particle: for liquids, and liquids with elastic bodies
    DUAL = ffi.integer_const("PBMPM_SOLVER_DUAL")
    #: the same equations in the displacements of the nodes: for elastic bodies
    PRIMAL = ffi.integer_const("PBMPM_SOLVER_PRIMAL")
    #: explicit MLS-MPM, to compare with; liquids need a bulk modulus
    EXPLICIT = ffi.integer_const("PBMPM_SOLVER_EXPLICIT")
    #: the default: per island of touching matter: liquid by itself and whatever sand touches by the dual, solids by the primal, solids in liquid by both
    CONVERGENT = ffi.integer_const("PBMPM_SOLVER_CONVERGENT")


class Pressure(Choice):
    """Where the dual solver keeps the pressure of a liquid."""

    PARTICLES = ffi.integer_const("PBMPM_PRESSURE_PARTICLES")  #: calm
    CELLS = ffi.integer_const("PBMPM_PRESSURE_CELLS")  #: lively; costs more, and pools stay restless


class Integrator(Choice):
    """How a substep follows from those before it."""

    EULER = ffi.integer_const("PBMPM_INTEGRATOR_EULER")  #: backward Euler: damps rotation and oscillation
    BDF2 = ffi.integer_const("PBMPM_INTEGRATOR_BDF2")  #: second order, primal solver only: hardly damps them


class Stop(Choice):
    """What ended the iterations of a substep."""

    ITERATIONS = ffi.integer_const("PBMPM_STOP_ITERATIONS")  #: all were done
    ERROR = ffi.integer_const("PBMPM_STOP_ERROR")  #: the predicted error fell below target_error
    TIME = ffi.integer_const("PBMPM_STOP_TIME")  #: time_budget_ms was spent


@dataclass(frozen=True)
class SettingsDefaults:
    """What a world has unless told otherwise; see the properties of `World`."""

    substeps: int
    iterations: int
    max_displacement: float
    solver: Solver
    pressure: Pressure
    integrator: Integrator
    flip: float
    target_error: float
    time_budget_ms: float
    sleep_speed: float
    sleep_time: float


_DECODED = {"substeps": int, "iterations": int, "solver": Solver, "pressure": Pressure, "integrator": Integrator}


def _defaults() -> SettingsDefaults:
    settings = initialised("pbmpm_settings")
    return SettingsDefaults(
        **{item.name: _DECODED.get(item.name, shortest)(getattr(settings, item.name)) for item in fields(SettingsDefaults)}
    )


#: Those of the C library, the only place that has them.
DEFAULTS = _defaults()


_SETTERS = {
    "gravity": axes("gravity"),
    "solver": choice("solver", Solver),
    "pressure": choice("pressure", Pressure),
    "integrator": choice("integrator", Integrator),
    "sleeping": flag("sleeping"),
    **{
        name: number(name)
        for name in (
            "substeps", "iterations", "max_displacement", "flip", "target_error", "time_budget_ms", "sleep_speed", "sleep_time"
        )
    },
}


class WorldSettings(WorldPart):
    """The settings of a `World` as properties. They take effect with the next step."""

    __slots__ = ()

    def _settings(self) -> Any:
        settings = sized("pbmpm_settings")
        self._call(lib.pbmpm_world_get_settings, settings)
        return settings

    def _change_settings(self, **values: Any) -> None:
        settings = self._settings()
        for name, value in values.items():
            _SETTERS[name](settings, value, self._dimension)
        self._call(lib.pbmpm_world_set_settings, settings)

    @property
    def gravity(self) -> tuple[float, ...]:
        """Acceleration [m/s^2]."""
        return tuple(plain(self._settings().gravity)[: self._dimension])

    @gravity.setter
    def gravity(self, value: Vector) -> None:
        self._change_settings(gravity=value)

    @property
    def substeps(self) -> int:
        """Equal parts that a step is cut into."""
        return int(self._settings().substeps)

    @substeps.setter
    def substeps(self, value: int) -> None:
        self._change_settings(substeps=value)

    @property
    def iterations(self) -> int:
        """Rounds of projection and transfer per substep; the explicit solver ignores them."""
        return int(self._settings().iterations)

    @iterations.setter
    def iterations(self, value: int) -> None:
        self._change_settings(iterations=value)

    @property
    def max_displacement(self) -> float:
        """Largest displacement of a particle per substep [cells]; faster ones are slowed to it, with an event."""
        return shortest(self._settings().max_displacement)

    @max_displacement.setter
    def max_displacement(self, value: float) -> None:
        self._change_settings(max_displacement=value)

    @property
    def solver(self) -> Solver:
        """How the equations of a substep are solved."""
        return Solver(self._settings().solver)

    @solver.setter
    def solver(self, value: Solver | str) -> None:
        self._change_settings(solver=value)

    @property
    def pressure(self) -> Pressure:
        """Where the dual solver keeps the pressure of a liquid."""
        return Pressure(self._settings().pressure)

    @pressure.setter
    def pressure(self, value: Pressure | str) -> None:
        self._change_settings(pressure=value)

    @property
    def integrator(self) -> Integrator:
        """How a substep follows from those before it."""
        return Integrator(self._settings().integrator)

    @integrator.setter
    def integrator(self, value: Integrator | str) -> None:
        self._change_settings(integrator=value)

    @property
    def flip(self) -> float:
        """Share, in [0, 1], of the motion below the grid's resolution that liquids keep; not the paper's solver."""
        return shortest(self._settings().flip)

    @flip.setter
    def flip(self, value: float) -> None:
        self._change_settings(flip=value)

    @property
    def target_error(self) -> float:
        """Dual and primal: iterations end when the predicted error [cells] is below this, in [0, 1]; 0: off."""
        return shortest(self._settings().target_error)

    @target_error.setter
    def target_error(self, value: float) -> None:
        self._change_settings(target_error=value)

    @property
    def time_budget_ms(self) -> float:
        """Dual and primal: no iteration is begun once this much wall time [ms] of the step is spent; 0: off. Results then
        depend on the machine's speed: they are not deterministic."""
        return shortest(self._settings().time_budget_ms)

    @time_budget_ms.setter
    def time_budget_ms(self, value: float) -> None:
        self._change_settings(time_budget_ms=value)

    # Sleeping

    @property
    def sleeping(self) -> bool:
        """Whether blocks of matter at rest fall asleep: they take no part in a step until something wakes them."""
        return bool(self._settings().sleeping)

    @sleeping.setter
    def sleeping(self, value: bool) -> None:
        self._change_settings(sleeping=value)

    @property
    def sleep_speed(self) -> float:
        """Root mean square speed [m/s] of a block's particles below which it is at rest."""
        return shortest(self._settings().sleep_speed)

    @sleep_speed.setter
    def sleep_speed(self, value: float) -> None:
        self._change_settings(sleep_speed=value)

    @property
    def sleep_time(self) -> float:
        """How long [s] a block and its neighbours must be at rest to fall asleep."""
        return shortest(self._settings().sleep_time)

    @sleep_time.setter
    def sleep_time(self, value: float) -> None:
        self._change_settings(sleep_time=value)

    def wake(self, shape: Shape | None = None) -> None:
        """Wakes what is within two cells of a shape, or everything. Matter that is touched wakes by itself."""
        self._call(lib.pbmpm_world_wake, ffi.NULL if shape is None else to_c(shape, self._dimension))
