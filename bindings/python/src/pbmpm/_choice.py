"""The base of all enumerations of the package."""

from __future__ import annotations

import enum

from .errors import InvalidArgumentError


class Choice(enum.Enum):
    """One of a few things. Where a member is wanted its name will do, in letters of any case: ``Solver("dual")``."""

    @classmethod
    def _missing_(cls, value: object) -> Choice:
        if isinstance(value, str) and value.upper() in cls.__members__:
            return cls[value.upper()]
        names = ", ".join(name.lower() for name in cls.__members__)
        raise InvalidArgumentError(f"{value!r} is no {cls.__name__}; there are {names}")
