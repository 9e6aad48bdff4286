"""Windows on the particles of a world, without copying."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
import numpy.typing as npt

from ._choice import Choice
from ._convert import sized
from ._ffi import ffi
from ._fixed import Bound
from ._library import lib
from .errors import ExpiredViewError

if TYPE_CHECKING:
    from ._handle import WorldHandle
    from .world import World


class Field(Choice):
    """A field of the particles; n particles, d dimensions."""

    POSITION = ffi.integer_const("PBMPM_POSITION")  #: (n, d) [m], relative to the origin
    VELOCITY = ffi.integer_const("PBMPM_VELOCITY")  #: (n, d) [m/s]
    AFFINE_VELOCITY = ffi.integer_const("PBMPM_AFFINE_VELOCITY")  #: (n, d, d) [1/s]
    VOLUME_RATIO = ffi.integer_const("PBMPM_VOLUME_RATIO")  #: (n,) J, or det F as of the last step
    DEFORMATION = ffi.integer_const("PBMPM_DEFORMATION")  #: (n, d, d) F; once there was a particle that is not liquid
    MATERIAL = ffi.integer_const("PBMPM_MATERIAL")  #: (n,) Material.index
    PARTICLE = ffi.integer_const("PBMPM_PARTICLE")  #: (n, 2) identifiers: index, generation
    MASS = ffi.integer_const("PBMPM_MASS")  #: (n,) [kg] (2D: per metre of depth)
    PRESSURE = ffi.integer_const("PBMPM_PRESSURE")  #: (n,) [Pa] of liquid, as the dual solver last solved for it
    USER_VALUE = ffi.integer_const("PBMPM_USER_VALUE")  #: (n,) the caller's own number; once a particle was given one


MATRICES = (Field.AFFINE_VELOCITY, Field.DEFORMATION)
INTEGERS = (Field.MATERIAL, Field.PARTICLE, Field.USER_VALUE)
_SCALARS = (Field.VOLUME_RATIO, Field.MATERIAL, Field.MASS, Field.PRESSURE, Field.USER_VALUE)


#: What `World.records()` gives for each particle.
RECORD = np.dtype([("position", np.float32, 3), ("velocity", np.float32, 3), ("material", np.uint32)])


class _Memory:
    """What NumPy makes an array from; as the array's base it keeps the world's memory alive."""

    __slots__ = ("__array_interface__", "_handle")

    def __init__(self, handle: WorldHandle, interface: dict[str, Any]) -> None:
        self._handle = handle
        self.__array_interface__ = interface


class View(Bound):
    """A read-only window on one field of the particles in the world's own memory.

    It expires with everything that moves, adds or removes particles: a step, a fill, a removal, a setter. An expired
    view raises ExpiredViewError instead of showing what is no longer true. A view that was taken while a step runs in the
    background shows a copy, and expires with the next `step_begin()` but one.

    `array()` and `numpy.asarray(view)` give the memory itself as a strided NumPy array. Such an array cannot know that
    it has expired: after the next change it shows values of one particle or another, so take it anew or work on `copy()`. It
    never dangles: the memory lives until the last array is gone, even when the world has been closed.
    Indexing a view gives a copy.

    Row i of all views taken between two changes is one particle. A step sorts the particles: then row i is another one. `World.ids` says which,
    and `World.find()` where a particle is now.
    """

    __slots__ = ("_world", "_field", "_generation", "_array")
    _instead = "it is a window on the memory of a world; copy() gives an array that stays"

    def __init__(self, world: World, field: Field) -> None:
        view = sized("pbmpm_view")
        handle = world._call(lib.pbmpm_particles_view, field.value, view)
        self._world = world
        self._field = field
        self._generation = int(view.generation)
        self._array = _wrap(handle, field, world.dimension, view)

    def __getattr__(self, name: str) -> NoReturn:
        """Says where an array's methods are."""
        there = not name.startswith("_") and hasattr(np.ndarray, name)
        raise AttributeError(f"'View' object has no attribute '{name}'" + (f"; array().{name} and copy().{name} are there" if there else ""))

    @property
    def field(self) -> Field:
        return self._field

    @property
    def generation(self) -> int:
        """The `World.generation` that the view belongs to."""
        return self._generation

    @property
    def expired(self) -> bool:
        """Whether the world has been closed or changed since; of a published state: whether two steps were begun since."""
        return self._world.closed or not (self._stays or self._world.generation == self._generation)

    @property
    def _stays(self) -> bool:
        return self._generation in self._world._published

    def array(self) -> npt.NDArray[Any]:
        """The memory itself, read-only; true until the world changes.

        Raises:
            ExpiredViewError: the world has changed since the view was taken.
            ClosedError: the world has been closed.
        """
        if self._stays and not self._world.closed:
            return self._array
        now = self._world.generation
        if now != self._generation:
            raise ExpiredViewError(
                f"this view of {self._field.name} has expired: the world has changed since "
                f"(generation {self._generation}, now {now}); take a new one"
            )
        return self._array

    def copy(self) -> npt.NDArray[Any]:
        """A packed copy that stays as it is."""
        return np.array(self.array(), order="C")

    @property
    def shape(self) -> tuple[int, ...]:
        return self._array.shape

    @property
    def dtype(self) -> np.dtype[Any]:
        return self._array.dtype

    def __len__(self) -> int:
        return len(self._array)

    def __getitem__(self, key: Any) -> Any:
        return np.array(self.array()[key])[()]

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        array = self.array()
        wanted = array.dtype if dtype is None else np.dtype(dtype)
        if copy is False and wanted != array.dtype:
            raise ValueError(f"a view of {array.dtype} cannot become {wanted} without a copy")
        return array.astype(wanted, copy=bool(copy))

    def __repr__(self) -> str:
        return f"<pbmpm.View {self._field.name} {self.shape} of generation {self._generation}>"


def _wrap(handle: WorldHandle, field: Field, dimension: int, view: Any) -> npt.NDArray[Any]:
    """A NumPy array over the memory that a C view describes."""
    step = view.component_stride
    shape: tuple[int, ...]
    strides: tuple[int, ...]
    if field in MATRICES:
        shape, strides = (view.count, dimension, dimension), (view.stride, dimension * step, step)
    elif field in _SCALARS:
        shape, strides = (view.count,), (view.stride,)
    else:
        shape, strides = (view.count, view.components), (view.stride, step)
    dtype = np.dtype(np.uint32 if field in INTEGERS else np.float32)
    if view.count == 0:
        empty = np.empty(shape, dtype)
        empty.flags.writeable = False
        return empty
    address = int(ffi.cast("uintptr_t", view.data))
    interface = {"version": 3, "typestr": dtype.str, "shape": shape, "strides": strides, "data": (address, True)}
    return np.asarray(_Memory(handle, interface))
