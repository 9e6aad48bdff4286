"""Steps that run while the caller does something else."""

from __future__ import annotations

from collections.abc import Iterable

from ._ffi import ffi
from ._library import lib
from ._member import WorldPart
from .errors import BusyError
from .views import Field


class WorldBackground(WorldPart):
    """Steps of a `World` in the background.

    Between `step_begin()` and the `step_end()` that returns True the world can be asked for its views of published fields,
    which show the state that the step began with, its number of particles, its generation and `step_stats`; everything else raises
    a BusyError. Closing the world waits for the step.
    """

    __slots__ = ()
    _published: tuple[int, int]  # generations of the last two begins: of the views that stay readable; 0: none

    def publish(self, fields: Iterable[Field | str]) -> None:
        """Sets which fields can be viewed while a step runs; until then POSITION, VELOCITY, MATERIAL and PARTICLE. Their copies
        take memory for twice `capacity` particles with the next `step_begin()`."""
        values = [Field(field).value for field in fields]
        self._call(lib.pbmpm_world_publish, ffi.new("pbmpm_field[]", values), len(values))

    def step_begin(self, dt: float) -> None:
        """Begins a step of `dt` seconds, in (0, 10], and returns. Expires all views but those that were taken while the step before
        ran: they show what they showed until the begin after this one, to any thread. So a renderer may be a frame late."""
        generation = ffi.new("uint64_t *")
        self._call(lib.pbmpm_world_step_begin, dt)
        self._call(lib.pbmpm_world_generation, generation)
        self._published = (int(generation[0]), self._published[0])

    def step_done(self) -> bool:
        """Whether the step that was begun is done, so that `step_end()` will not wait. Made to be asked in each frame.

        Raises:
            InvalidArgumentError: no step was begun.
        """
        done = ffi.new("int32_t *")
        self._call(lib.pbmpm_world_step_done, done)
        return bool(done[0])

    def step_end(self, wait: bool = True) -> bool:
        """Ends a step that was begun. The views that were taken while it ran stay as they are until the next begin but one.

        Args:
            wait: whether to wait for the step; otherwise this only looks whether it is done.

        Returns:
            Whether the step has ended. False: it goes on; ask again.

        Raises:
            InvalidArgumentError: no step was begun.
            OutOfMemoryError: as `World.step()` would have raised it.
        """
        try:
            self._call(lib.pbmpm_world_step_end, bool(wait))
        except BusyError:
            if wait:
                raise
            return False
        return True
