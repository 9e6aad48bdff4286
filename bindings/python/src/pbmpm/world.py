"""Worlds: matter, obstacles, settings and the step."""

from __future__ import annotations

from types import TracebackType
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from . import colliders, materials, shapes
from ._convert import Vector, assign, assign_vector, floats, identifiers, initialised, integers, plain, pointer, shortest, sized, sized_array
from ._ffi import ffi
from ._fixed import tells_names
from ._handle import WorldHandle
from ._library import lib
from ._member import Member
from .advice import WorldAdvice
from .background import WorldBackground
from .colliders import Collider, Friction, Meets, Touch
from .debug import WorldDebug
from .domain import WorldDomain
from .errors import ClosedError, InvalidArgumentError, check
from .flow import Drain, Emitter, WorldFlow
from .forces import Force, WorldForces
from .materials import Material, Parameters
from .queries import WorldQueries
from .settings import Integrator, Pressure, Solver, WorldSettings
from .shapes import Shape
from .snapshots import WorldSnapshots
from .solids import WorldSolids
from .stats import Event, Stats, StepStats, event_from_c, stats_from_c
from .surface import WorldSurface
from .views import INTEGERS, MATRICES, RECORD, Field, View

Found = TypeVar("Found", bound=Member)

#: Identifiers of particles: shape (n, 2), index and generation. A generation alone is unique in a process.
Ids = npt.NDArray[np.uint32]


@tells_names
class World(
    WorldSettings,
    WorldFlow,
    WorldForces,
    WorldQueries,
    WorldSnapshots,
    WorldBackground,
    WorldSolids,
    WorldDomain,
    WorldDebug,
    WorldSurface,
    WorldAdvice,
):
    """A world of liquid and elastic matter.

    Lengths are in metres, times in seconds, masses in kilograms; in 2D masses are per metre of depth. Vectors have one
    number per axis. Everything that does not fit raises a `PbmpmError`, and the world is then as it was before.

    Use it as a context manager, or call `close()`; a forgotten world is destroyed when it is collected. Calls release
    Python's global lock: different worlds may step at the same time in different threads. Calls that only read share a
    world; one that changes it gets a BusyError while another thread is inside a call.

    Args:
        dimension: 2 or 3.
        cell_size: grid spacing [m].
        capacity: hard limit of the number of particles; memory for them is taken at once.
        gravity: acceleration [m/s^2].
        domain: lower and upper corner [m] of a closed box that holds matter in; None: unbounded.
        domain_friction: Coulomb coefficient of the box's walls; default 0, on which sand makes no heap.
        domain_measures_impulse: whether `wall_impulse()` tells what matter does to them.
        origin: what positions are relative to [m]; for the caller's own conversion.
        memory_budget: bytes that the world may hold at once; 0: no limit.
        threads: threads that share the work, counting the caller; 0: one per core. Results do not depend on it.
        substeps, iterations, max_displacement, solver, pressure, integrator, flip, target_error, time_budget_ms, sleeping,
            sleep_speed, sleep_time: see the properties.

    Arguments left at None take the C library's defaults.
    """

    __slots__ = ("_handle", "_dimension", "_published", "__weakref__")
    _instead = "snapshot() keeps its state, and restore() brings it into a world that was made by the same calls"

    def __init__(
        self,
        dimension: int | None = None,
        cell_size: float | None = None,
        *,
        capacity: int | None = None,
        gravity: Vector | None = None,
        domain: tuple[Vector, Vector] | None = None,
        domain_friction: float | None = None,
        domain_measures_impulse: bool | None = None,
        origin: Vector | None = None,
        memory_budget: int | None = None,
        threads: int | None = None,
        substeps: int | None = None,
        iterations: int | None = None,
        max_displacement: float | None = None,
        solver: Solver | str | None = None,
        pressure: Pressure | str | None = None,
        integrator: Integrator | str | None = None,
        flip: float | None = None,
        target_error: float | None = None,
        time_budget_ms: float | None = None,
        sleeping: bool | None = None,
        sleep_speed: float | None = None,
        sleep_time: float | None = None,
    ) -> None:
        self._handle: WorldHandle | None = None
        self._published = (0, 0)
        definition = initialised("pbmpm_world_def")
        numbers = {
            "dimension": dimension,
            "cell_size": cell_size,
            "particle_capacity": capacity,
            "domain_friction": domain_friction,
            "domain_measures_impulse": domain_measures_impulse,
            "memory_budget": memory_budget,
            "thread_count": threads,
        }
        for name, value in numbers.items():
            if value is not None:
                assign(definition, name, value)
        axes = definition.dimension if definition.dimension in (2, 3) else 3
        if origin is not None:
            assign_vector(definition, "origin", origin, axes)
        if domain is not None:
            definition.domain_enabled = 1
            lower, upper = domain
            assign_vector(definition, "domain_min", lower, axes)
            assign_vector(definition, "domain_max", upper, axes)
        self._handle = WorldHandle(definition)
        self._dimension = int(definition.dimension)
        settings = dict(
            gravity=gravity,
            substeps=substeps,
            iterations=iterations,
            max_displacement=max_displacement,
            solver=solver,
            pressure=pressure,
            integrator=integrator,
            flip=flip,
            target_error=target_error,
            time_budget_ms=time_budget_ms,
            sleeping=sleeping,
            sleep_speed=sleep_speed,
            sleep_time=sleep_time,
        )
        self._change_settings(**{name: value for name, value in settings.items() if value is not None})

    # Life

    def close(self) -> None:
        """Ends the use of the world; further calls raise ClosedError. A second close does nothing.

        Its memory is released at once, or, when views or arrays over it are still alive, with the last of them.
        """
        self._handle = None

    @property
    def closed(self) -> bool:
        return self._handle is None

    def __enter__(self) -> World:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        if self._handle is None:
            return "<pbmpm.World, closed>"
        return f"<pbmpm.World {self._dimension}D, cell size {self.cell_size} m, {len(self)} particles>"

    def _call(self, function: Any, *arguments: Any) -> WorldHandle:
        """Calls a function of the C library with this world. The handle cannot be destroyed meanwhile, for this frame
        holds it, and it is returned for those who want to go on holding it."""
        handle = self._handle
        if handle is None:
            raise ClosedError("the world has been closed")
        check(function(handle.id, *arguments))
        return handle

    def _number(self, function: Any, ctype: str, *arguments: Any) -> int:
        """Calls a function whose last parameter receives a number."""
        out = ffi.new(f"{ctype} *")
        self._call(function, *arguments, out)
        return int(out[0])

    def _vector(self, components: Any) -> tuple[float, ...]:
        """A vector of a C structure, which always has three components."""
        return tuple(plain(components)[: self._dimension])

    # What the world was made of

    def _definition(self) -> Any:
        definition = sized("pbmpm_world_def")
        self._call(lib.pbmpm_world_get_def, definition)
        return definition

    @property
    def dimension(self) -> int:
        """2 or 3."""
        return self._dimension

    @property
    def cell_size(self) -> float:
        """Grid spacing [m]."""
        return shortest(self._definition().cell_size)

    @property
    def capacity(self) -> int:
        """Hard limit of the number of particles."""
        return int(self._definition().particle_capacity)

    @property
    def domain(self) -> tuple[tuple[float, ...], tuple[float, ...]] | None:
        """Lower and upper corner [m] of the closed box; None when unbounded."""
        definition = self._definition()
        if not definition.domain_enabled:
            return None
        return self._vector(definition.domain_min), self._vector(definition.domain_max)

    @property
    def domain_friction(self) -> float:
        """Coulomb coefficient of the box's walls."""
        return shortest(self._definition().domain_friction)

    @property
    def origin(self) -> tuple[float, ...]:
        """What positions are relative to [m]."""
        return self._vector(self._definition().origin)

    @property
    def memory_budget(self) -> int:
        """Bytes that the world may hold at once; 0: no limit."""
        return int(self._definition().memory_budget)

    @property
    def threads(self) -> int:
        """Threads as asked for at creation; 0: one per core."""
        return int(self._definition().thread_count)

    # Matter

    def add_material(self, parameters: Parameters, *, key: int = 0) -> Material:
        """Adds a material.

        Args:
            parameters: a `Liquid`, `Elastic`, `Sand` or `Visco`.
            key: what snapshots know it by, a number that no other material of the world has; 0: its place.
        """
        definition = materials.to_c(parameters)
        assign(definition, "key", key)
        out = ffi.new("pbmpm_material_id *")
        self._call(lib.pbmpm_material_create, definition, out)
        return Material(self, out[0])

    def add_particles(
        self,
        material: Material,
        positions: npt.ArrayLike,
        velocities: npt.ArrayLike | None = None,
        volumes: npt.ArrayLike | None = None,
        user_values: npt.ArrayLike | None = None,
    ) -> Ids:
        """Adds particles from arrays: all of them or none.

        Args:
            material: their material.
            positions: shape (n, d) [m], relative to the origin, inside the domain.
            velocities: shape (n, d) [m/s]; None: at rest.
            volumes: rest volumes, one number or shape (n,) [m^d]; None: (cell_size / 2)^d.
            user_values: 32-bit numbers of the caller's own, shape (n,), see `Field.USER_VALUE`; None: 0.

        Returns:
            Their identifiers, shape (n, 2).
        """
        place = floats("positions", positions, (-1, self._dimension))
        count = len(place)
        speed = None if velocities is None else floats("velocities", velocities, (count, self._dimension))
        definition = initialised("pbmpm_particles_def")
        sizes = None
        if volumes is not None and np.ndim(volumes) == 0:
            if not float(volumes) > 0:  # type: ignore[arg-type]
                raise InvalidArgumentError(f"volumes: {volumes} is not greater than 0")
            assign(definition, "volume", volumes)
        elif volumes is not None:
            sizes = floats("volumes", volumes, (count,))
        numbers = None if user_values is None else integers("user_values", user_values, (count,))
        pointers = [pointer("float", array) for array in (place, speed, sizes)]
        definition.user_values = pointer("uint32_t", numbers)
        definition.count, definition.material = count, self._id_of(material)
        definition.positions, definition.velocities, definition.volumes = pointers
        ids = np.empty((count, 2), np.uint32)
        self._call(lib.pbmpm_particles_add, definition, pointer("pbmpm_particle_id", ids, writable=True))
        return ids

    def fill(
        self,
        shape: Shape,
        material: Material,
        *,
        particles_per_axis: float | None = None,
        jitter: float | None = None,
        seed: int | None = None,
        velocity: Vector | None = None,
        user_value: int | None = None,
    ) -> int:
        """Fills a shape (not a plane) with particles on a jittered lattice.

        Particles that are there already do not count: two fills of one place overlap, of which `advice()` warns. To make
        room first, call `remove_in(shape)`. To leave a place out, put a collider there while you fill, and destroy it.

        Args:
            shape: what to fill; lattice points outside the domain or in an obstacle are left out.
            material: of the particles.
            particles_per_axis: lattice points per cell and axis, in [0.25, 16]; default 2.
            jitter: random offset as a share of the lattice spacing, in [0, 1]; default 0.5.
            seed: of the jitter; equal seeds give equal particles.
            velocity: of every particle [m/s]; default at rest.
            user_value: of every particle, see `Field.USER_VALUE`; default 0.

        Returns:
            How many particles were added.

        Raises:
            InvalidArgumentError: no point of the lattice is inside of the shape and of the domain.
            CapacityError: there is no room and nothing was added; message and event say how many the shape needs.
        """
        definition = initialised("pbmpm_fill_def")
        definition.material = self._id_of(material)
        numbers = {"particles_per_axis": particles_per_axis, "jitter": jitter, "seed": seed, "user_value": user_value}
        for name, value in numbers.items():
            if value is not None:
                assign(definition, name, value)
        if velocity is not None:
            assign_vector(definition, "velocity", velocity, self._dimension)
        return self._number(lib.pbmpm_particles_fill, "uint32_t", definition, shapes.to_c(shape, self._dimension))

    def remove(self, ids: npt.ArrayLike) -> None:
        """Removes particles, shape (n, 2); with an unknown identifier none is removed."""
        array = identifiers(ids)
        self._call(lib.pbmpm_particles_remove, pointer("pbmpm_particle_id", array), len(array))

    def remove_in(self, shape: Shape) -> int:
        """Removes all particles inside a shape and says how many."""
        return self._number(lib.pbmpm_particles_remove_in, "uint32_t", shapes.to_c(shape, self._dimension))

    def find(self, ids: npt.ArrayLike) -> npt.NDArray[np.uint32]:
        """The rows, shape (n,), at which particles with these identifiers stand in the views of now."""
        array = identifiers(ids)
        rows = np.empty(len(array), np.uint32)
        pointers = pointer("pbmpm_particle_id", array), len(array), pointer("uint32_t", rows, writable=True)
        self._call(lib.pbmpm_particles_find, *pointers)
        return rows

    def query(self, shape: Shape) -> Ids:
        """Identifiers of the particles inside a shape, shape (n, 2), in storage order."""
        return self._query(lib.pbmpm_query_shape, shapes.to_c(shape, self._dimension))

    def _query(self, function: Any, what: Any) -> Ids:
        room = np.empty((len(self), 2), np.uint32)
        found = self._number(function, "uint32_t", what, pointer("pbmpm_particle_id", room, writable=True), len(room))
        return room[:found].copy()

    def __len__(self) -> int:
        """Number of live particles."""
        return self._number(lib.pbmpm_particles_count, "uint32_t")

    def __bool__(self) -> bool:
        return True

    def _id_of(self, material: Material) -> Any:
        if not isinstance(material, Material):
            raise TypeError(f"material: a Material is needed (World.add_material), not {type(material).__name__}")
        return material._id

    # Fields of the particles

    def view(self, field: Field | str) -> View:
        """A view of a field; it expires with the next change."""
        return View(self, Field(field))

    def set(self, field: Field | str, values: npt.ArrayLike, ids: npt.ArrayLike | None = None) -> None:
        """Writes a field of some particles, or of all of them in storage order.

        Args:
            field: POSITION, VELOCITY, AFFINE_VELOCITY, VOLUME_RATIO or PRESSURE (liquid), DEFORMATION (elastic) or USER_VALUE.
            values: one row per particle, shaped as in the view.
            ids: shape (n, 2); None: all particles.
        """
        field = Field(field)
        chosen = None if ids is None else identifiers(ids)
        count = len(self) if chosen is None else len(chosen)
        columns: tuple[int, ...] = (self._dimension,) if field in (Field.POSITION, Field.VELOCITY) else ()
        if field in MATRICES:
            columns = (self._dimension, self._dimension)
        read = integers if field in INTEGERS else floats
        array = read(field.name.lower(), values, (count, *columns))
        pointers = pointer("pbmpm_particle_id", chosen), count, pointer("char", array)
        self._call(lib.pbmpm_particles_set, field.value, *pointers)

    @property
    def positions(self) -> View:
        """Positions, shape (n, d) [m], relative to the origin. Assigning writes those of all particles. A step changes the order of particles, see `View`."""
        return self.view(Field.POSITION)

    @positions.setter
    def positions(self, values: npt.ArrayLike) -> None:
        self.set(Field.POSITION, values)

    def positions_at(self, alpha: float) -> npt.NDArray[np.float32]:
        """Positions between steps, for rendering: a copy of shape (n, d) [m] at the share `alpha` in [0, 1] of the way from before
        the last step (0) to now (1)."""
        definition = initialised("pbmpm_copy_def")
        fields = ffi.new("pbmpm_field[]", [ffi.integer_const("PBMPM_POSITION")])
        definition.fields, definition.field_count = fields, 1
        return self._copy(definition, alpha, np.empty((len(self), self._dimension), np.float32))

    def records(self, alpha: float = 1.0) -> npt.NDArray[Any]:
        """What a renderer uploads to a GPU: for each particle a record of 28 bytes (`pbmpm.RECORD`), alike in 2D and 3D: "position" and
        "velocity" of three numbers, in 2D the third is 0, and "material", its index. `alpha`: as for `positions_at()`."""
        definition = initialised("pbmpm_copy_def")
        definition.pads_vectors = 1
        return self._copy(definition, alpha, np.empty(len(self), RECORD))

    def _copy(self, definition: Any, alpha: float, room: npt.NDArray[Any]) -> npt.NDArray[Any]:
        assign(definition, "alpha", alpha)
        out = pointer("char", room, writable=True) if room.size else ffi.NULL
        self._call(lib.pbmpm_particles_copy, definition, out, room.nbytes, ffi.new("uint32_t *"))
        return room

    @property
    def velocities(self) -> View:
        """Velocities, shape (n, d) [m/s]. Assigning writes those of all particles."""
        return self.view(Field.VELOCITY)

    @velocities.setter
    def velocities(self, values: npt.ArrayLike) -> None:
        self.set(Field.VELOCITY, values)

    @property
    def affine_velocities(self) -> View:
        """Velocity gradients, shape (n, d, d) [1/s]. Assigning writes those of all particles."""
        return self.view(Field.AFFINE_VELOCITY)

    @affine_velocities.setter
    def affine_velocities(self, values: npt.ArrayLike) -> None:
        self.set(Field.AFFINE_VELOCITY, values)

    @property
    def volume_ratios(self) -> View:
        """Volume relative to the rest volume, shape (n,): J, or det F of elastic matter as of its last step; J of sand with the dual or the convergent solver."""
        return self.view(Field.VOLUME_RATIO)

    @property
    def deformations(self) -> View:
        """Deformation gradients F, shape (n, d, d); only once the world had a particle that is not liquid. Of sand see `PBMPM_DEFORMATION` in the header."""
        return self.view(Field.DEFORMATION)

    @property
    def material_indices(self) -> View:
        """`Material.index` of each particle, shape (n,), in the order of now: a step changes it, see `View`."""
        return self.view(Field.MATERIAL)

    @property
    def ids(self) -> View:
        """Identifiers, shape (n, 2): index and generation."""
        return self.view(Field.PARTICLE)

    @property
    def masses(self) -> View:
        """Masses, shape (n,) [kg] (2D: per metre of depth)."""
        return self.view(Field.MASS)

    @property
    def pressures(self) -> View:
        """Pressures of liquid particles, and of sand with the dual or the convergent solver, as last solved for, shape (n,) [Pa] (2D: N/m)."""
        return self.view(Field.PRESSURE)

    @property
    def user_values(self) -> View:
        """The caller's own 32-bit numbers, shape (n,); only once a particle was given one. Assigning writes those of all particles."""
        return self.view(Field.USER_VALUE)

    @user_values.setter
    def user_values(self, values: npt.ArrayLike) -> None:
        self.set(Field.USER_VALUE, values)

    # What there is

    def _members(self, kind: type[Found], many: str) -> list[Found]:
        function, count = getattr(lib, f"pbmpm_world_get_{many}"), ffi.new("uint32_t *")
        self._call(function, ffi.NULL, 0, count)
        found = ffi.new(f"pbmpm_{kind._name}_id[]", max(1, count[0]))
        self._call(function, found, count[0], count)
        return [kind(self, ffi.new(f"pbmpm_{kind._name}_id *", found[i])[0]) for i in range(count[0])]

    @property
    def materials(self) -> list[Material]:
        """All materials of the world."""
        return self._members(Material, "materials")

    @property
    def colliders(self) -> list[Collider]:
        """All obstacles of the world."""
        return self._members(Collider, "colliders")

    @property
    def emitters(self) -> list[Emitter]:
        """All emitters of the world."""
        return self._members(Emitter, "emitters")

    @property
    def drains(self) -> list[Drain]:
        """All drains of the world."""
        return self._members(Drain, "drains")

    @property
    def forces(self) -> list[Force]:
        """All forces of the world."""
        return self._members(Force, "forces")

    # Obstacles

    def add_collider(
        self,
        shape: Shape,
        *,
        friction: Friction | str = Friction.COULOMB,
        friction_coefficient: float | None = None,
        kinematic: bool = False,
        measures_impulse: bool = False,
        meets: Meets = 0,
        sensor: bool = False,
        reports_touches: bool = False,
        key: int = 0,
    ) -> Collider:
        """Adds an obstacle.

        Args:
            shape: with its pose.
            friction: how matter moves along its surface.
            friction_coefficient: Coulomb coefficient, in [0, 100].
            kinematic: whether `Collider.move()` may move it.
            measures_impulse: whether `Collider.impulse` tells what matter does to it; costs nothing when not.
            meets: the material or materials that it acts on, or their groups, bit by bit; 0: all. Materials are told apart by their `groups`, which are
                the same unless they say otherwise; one that is added later is looked at as it comes. What passes is braked within some 2.5
                cells of what is held, and held along within 1.5.
            sensor: whether it acts on nothing, for triggers: matter passes through it.
            reports_touches: whether `touches()` tells what touches it.
            key: what snapshots know it by, a number that no other collider of the world has; 0: its place.
        """
        values = {
            "friction": friction,
            "friction_coefficient": friction_coefficient,
            "kinematic": kinematic,
            "measures_impulse": measures_impulse,
            "meets": colliders.groups_of(self, meets),
            "sensor": sensor,
            "reports_touches": reports_touches,
        }
        definition = colliders.fill(initialised("pbmpm_collider_def"), values)
        assign(definition, "key", key)
        out = ffi.new("pbmpm_collider_id *")
        self._call(lib.pbmpm_collider_create, definition, shapes.to_c(shape, self._dimension), out)
        return Collider(self, out[0])

    def touches(self) -> list[Touch]:
        """Which materials touch the colliders that report touches, and where that has begun or ended since it was asked before. To be asked
        once per step. A particle touches an obstacle that it is within half a cell of, and a sensor that it is in."""
        count = ffi.new("uint32_t *")
        self._call(lib.pbmpm_world_touches, ffi.NULL, 0, count)
        found = sized_array("pbmpm_touch", count[0])
        self._call(lib.pbmpm_world_touches, found, count[0], count)
        return [colliders.touch_from_c(self, touch) for touch in found]

    # The step

    def step(self, dt: float) -> None:
        """Advances the world by `dt` seconds, in (0, 10], in `substeps` equal parts. Expires all views."""
        self._call(lib.pbmpm_world_step, dt)

    @property
    def generation(self) -> int:
        """A number that changes with every call that moves, adds or removes particles."""
        return self._number(lib.pbmpm_world_generation, "uint64_t")

    @property
    def stats(self) -> Stats:
        """Figures of the last step and of the present state, for which all particles are gone over."""
        stats = sized("pbmpm_stats")
        self._call(lib.pbmpm_world_get_stats, stats)
        return stats_from_c(stats, Stats)

    @property
    def step_stats(self) -> StepStats:
        """Figures that the last step has left behind: made to be asked in each frame. While a step runs in the background they are
        those of the step before it."""
        stats = sized("pbmpm_stats")
        self._call(lib.pbmpm_world_get_step_stats, stats)
        return stats_from_c(stats, StepStats)

    @property
    def events(self) -> list[Event]:
        """What happened in the last step and in calls since then, as far as the library kept it."""
        return self._events()[0]

    @property
    def events_missed(self) -> int:
        """How many events of the last step are not in `events` for want of room."""
        return self._events()[1]

    def _events(self) -> tuple[list[Event], int]:
        numbers = ffi.new("uint32_t[2]")
        self._call(lib.pbmpm_world_events, ffi.NULL, 0, numbers, numbers + 1)
        events = sized_array("pbmpm_event", numbers[0])
        self._call(lib.pbmpm_world_events, events, numbers[0], numbers, numbers + 1)
        return [event_from_c(event, self._dimension) for event in events], numbers[1]

    def hash(self) -> int:
        """64-bit hash of the state of all particles. Equal for the same calls on the same library and instruction
        set, for any number of threads."""
        return self._number(lib.pbmpm_world_hash, "uint64_t")
