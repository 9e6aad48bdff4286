"""What the parts of a `World` have in common, and what the things in it have: an identifier, a definition, an end."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from ._convert import Rotation, Vector, quaternion, sized, vector
from ._ffi import ffi
from ._fixed import Bound
from ._library import lib

if TYPE_CHECKING:
    from .world import World


class WorldPart(Bound):
    """A share of the methods of a `World`."""

    __slots__ = ()
    _dimension: int

    def _call(self, function: Any, *arguments: Any) -> Any:
        """Calls a function of the C library with this world."""
        raise NotImplementedError


class Member(Bound):
    """A thing in a world that the C library knows by an identifier: ``pbmpm_<name>_get()`` reads its definition."""

    __slots__ = ("_world", "_id")
    _instead = "it names a thing of one world; World.snapshot() keeps the state of all of them"
    _name: ClassVar[str]
    _has_shape: ClassVar[bool] = False

    def __init__(self, world: World, identifier: Any) -> None:
        self._world = world
        self._id = identifier

    def _apply(self, verb: str, *arguments: Any) -> None:
        self._world._call(getattr(lib, f"pbmpm_{self._name}_{verb}"), self._id, *arguments)

    def _definition(self) -> Any:
        out = sized(f"pbmpm_{self._name}_def")
        self._apply("get", out, *([ffi.NULL] if self._has_shape else []))
        return out

    def _redefine(self, definition: Any) -> None:
        """Gives it another definition; its shape stays."""
        self._apply("set", definition, *([ffi.NULL] if self._has_shape else []))

    def _form(self) -> Any:
        """The C structure of the shape with its current pose."""
        out = sized("pbmpm_shape")
        self._apply("get", ffi.NULL, out)
        return out

    def _status(self) -> Any:
        out = sized(f"pbmpm_{self._name}_status")
        self._apply("status_get", out)
        return out

    def _set_pose(self, verb: str, position: Vector, rotation: Rotation | None) -> None:
        c_position = ffi.new("float[3]", vector("position", position, self._world.dimension))
        c_rotation = ffi.NULL if rotation is None else ffi.new("float[4]", quaternion(rotation))
        self._apply(verb, c_position, c_rotation)

    @property
    def key(self) -> int:
        """What snapshots know it by, as given when it was added; 0: its place in the world."""
        return int(self._definition().key)

    @property
    def valid(self) -> bool:
        """Whether it is still in its world. False, too, when the world has been closed."""
        if self._world.closed:
            return False
        return bool(self._world._number(getattr(lib, f"pbmpm_{self._name}_is_valid"), "int32_t", self._id))

    def destroy(self) -> None:
        """Removes it from the world; particles stay."""
        self._apply("destroy")

    def __repr__(self) -> str:
        return f"<pbmpm.{type(self).__name__} {self._id.index}:{self._id.generation}>"
