"""Bases of what the package hands out: objects that take no attributes but their own, and those that cannot be copied."""

from __future__ import annotations

import difflib
import functools
import inspect
from collections.abc import Iterable
from typing import Any, ClassVar, NoReturn, TypeVar

Anything = TypeVar("Anything")


def nearest(name: object, names: Iterable[str]) -> str:
    """The end of a message about a name that does not exist: which of some others it may stand for, if any is like it. First come those of the same parts
    in another order, then those that begin with its parts."""
    written, known = str(name).lower(), {other.lower(): other for other in names}
    turned = [other for other in known if sorted(other.split("_")) == sorted(written.split("_"))]
    longer = [other for other in known if other.startswith(f"{written}_")]
    alike = turned or difflib.get_close_matches(written, longer, 1, cutoff=0.0) or difflib.get_close_matches(written, known, 1)
    return f"; did you mean '{known[alike[0]]}'?" if alike else ""


def tells_names(kind: type[Anything]) -> type[Anything]:
    """A class whose constructor names the parameter that a wrong one may stand for."""
    plain = vars(kind)["__init__"]
    known = [name for name in inspect.signature(plain).parameters if name != "self"]

    @functools.wraps(plain)
    def made(self: Any, *values: Any, **named: Any) -> None:
        for name in named:
            if name not in known:
                raise TypeError(f"{type(self).__name__} has no parameter '{name}'{nearest(name, known) or '; it has ' + ', '.join(known)}")
        plain(self, *values, **named)

    setattr(kind, "__init__", made)
    return kind


class Fixed:
    """Has only the attributes that its class declares: assigning to another one is an AttributeError, not a new attribute.
    A subclass that keeps something of its own declares it: ``score = 0``."""

    __slots__ = ()

    def __setattr__(self, name: str, value: Any) -> None:
        kind = type(self)
        if not hasattr(kind, name):
            known = [item for item in dir(kind) if not item.startswith("_") and not callable(getattr(kind, item))]
            raise AttributeError(f"{kind.__name__} has no attribute '{name}'{nearest(name, known)}")
        super().__setattr__(name, value)


class Bound(Fixed):
    """Stands for something that a world owns. A copy would be a second name of the same thing, so there are none."""

    __slots__ = ()
    _instead: ClassVar[str]  #: what to do in place of a copy

    def __reduce_ex__(self, protocol: Any) -> NoReturn:
        raise TypeError(f"{type(self).__name__} objects cannot be copied or pickled: {self._instead}")
