"""Which settings are worth their time: the Pareto front of error against cost, and what an error costs along it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol, TypeVar


class Priced(Protocol):
    """Something with a cost and an error."""

    @property
    def cost(self) -> float: ...

    @property
    def error(self) -> float: ...


AnyPriced = TypeVar("AnyPriced", bound=Priced)


@dataclass(frozen=True)
class Point:
    """One measured setting that did not fail; both figures are above 0."""

    solver: str
    setting: str  #: for people
    cost: float  #: milliseconds
    error: float
    pace: str = ""  #: Hz x iterations, for labels


_MARGIN = 1.25
_LEAST_SPAN = 3.0


def axis_span(costs: Iterable[float], mark: float) -> tuple[float, float]:
    """From where to where a logarithmic axis of costs goes: over all of them, and over a mark while at least half of the axis is data."""
    known = [cost for cost in costs if cost > 0.0] or [mark]
    low, high = min(known), max(known)
    span = max(high / low, _LEAST_SPAN)
    if low / span <= mark <= high * span:
        low, high = min(low, mark), max(high, mark)
    return low / _MARGIN, high * _MARGIN


def front_of(points: Iterable[AnyPriced]) -> list[AnyPriced]:
    """The points that no other beats in both cost and error, cheap ones first."""
    front: list[AnyPriced] = []
    for point in sorted(points, key=lambda item: (item.cost, item.error)):
        if not front or point.error < front[-1].error:
            front.append(point)
    return front


def cost_of(front: Sequence[Priced], error: float) -> float | None:
    """What reaching an error costs along a front; None when it never gets there.

    Between two neighbours the front is taken as straight in logarithms of both figures. An error that the cheapest
    point already undercuts costs as much as that point: there is nothing cheaper to interpolate with.
    """
    if not front or error < front[-1].error:
        return None
    dearer = next(index for index, point in enumerate(front) if point.error <= error)
    if dearer == 0:
        return front[0].cost
    before, after = front[dearer - 1], front[dearer]
    way = math.log(before.error / error) / math.log(before.error / after.error)
    return before.cost * (after.cost / before.cost) ** way
