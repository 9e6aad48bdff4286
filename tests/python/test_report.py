"""Pareto fronts, verdicts, and the page that shows them."""

from __future__ import annotations

import pytest

from pbmpm.app.report.pareto import Point, cost_of, front_of
from pbmpm.app.report.verdict import judge, round_levels


def line(solver: str, factor: float, errors: list[float]) -> list[Point]:
    """Settings whose error falls as 1 / cost: error * cost = factor."""
    return [Point(solver, f"{error:g}", factor / error, error) for error in errors]


def test_front_keeps_what_nothing_beats() -> None:
    points = [Point("a", "dear", 9, 0.1), Point("a", "cheap", 1, 0.5), Point("b", "beaten", 2, 0.6), Point("b", "ok", 3, 0.2)]
    assert [point.setting for point in front_of(points)] == ["cheap", "ok", "dear"]


def test_front_keeps_one_of_equals() -> None:
    assert len(front_of([Point("a", "x", 1, 0.5), Point("a", "y", 1, 0.5), Point("a", "z", 2, 0.5)])) == 1


def test_cost_between_two_points_is_straight_in_logarithms() -> None:
    """error = 1 / cost is a straight line there, so the interpolation is exact but for rounding."""
    front = front_of(line("a", 1.0, [0.5, 0.01]))
    assert cost_of(front, 0.1) == pytest.approx(10.0, rel=1e-12)


def test_cost_outside_the_front() -> None:
    front = front_of(line("a", 1.0, [0.5, 0.01]))
    assert cost_of(front, 0.009) is None
    assert cost_of(front, 0.9) == 2.0
    assert cost_of([], 0.5) is None


def test_verdict_of_a_solver_four_times_cheaper() -> None:
    dual = line("dual", 1.0, [0.5, 0.1, 0.02, 0.001])
    points = [*dual, *line("paper", 4.0, [0.6, 0.05]), *line("explicit", 20.0, [0.3, 0.1])]
    verdict = judge(points, ["dual", "paper", "explicit"])
    paper, explicit = verdict.comparisons
    assert paper.level == 0.05
    assert paper.ratio == pytest.approx(4.0)
    assert explicit.ratio == pytest.approx(20.0)
    assert verdict.best_error == 0.001
    assert verdict.alone_on_front and verdict.passed


def test_verdict_of_a_solver_that_is_not_cheap_enough() -> None:
    points = [*line("primal", 1.0, [0.5, 0.01]), *line("paper", 2.0, [0.5, 0.01]), *line("explicit", 20.0, [0.5, 0.01])]
    verdict = judge(points, ["primal", "paper", "explicit"])
    assert verdict.comparisons[0].ratio == pytest.approx(2.0)
    assert not verdict.comparisons[0].reached
    assert verdict.comparisons[1].reached
    assert verdict.alone_on_front and not verdict.passed


def test_verdict_names_others_on_the_front() -> None:
    points = [*line("dual", 1.0, [0.1, 0.01]), Point("paper", "cheap", 0.5, 0.9)]
    verdict = judge(points, ["dual", "paper", "explicit"])
    assert verdict.solvers_on_front == ("paper", "dual")
    assert not verdict.passed


def test_verdict_when_the_other_goes_further() -> None:
    """The accelerated stop at 0.1; the paper's reaches 0.01. They are compared at 0.1."""
    verdict = judge([*line("dual", 1.0, [0.5, 0.1]), *line("paper", 1.0, [0.5, 0.01])], ["dual", "paper"])
    paper, explicit = verdict.comparisons
    assert (paper.level, paper.best_error) == (0.1, 0.01)
    assert paper.ratio == pytest.approx(1.0)
    assert not explicit.measured and not explicit.reached


def test_verdict_where_the_other_is_never_stable() -> None:
    verdict = judge(line("dual", 1.0, [0.5, 0.1]), ["dual", "paper", "explicit"])
    assert all(comparison.best_error is None and comparison.reached for comparison in verdict.comparisons)
    assert verdict.levels[0].costs["paper"] is None


def test_verdict_without_a_stable_accelerated_setting() -> None:
    verdict = judge(line("paper", 1.0, [0.5, 0.1]), ["dual", "paper"])
    assert verdict.best_error is None
    assert not verdict.passed


def test_lowest_ratio_is_that_of_the_worst_error() -> None:
    """The paper's costs 8 times as much at 0.01 and 2 times at 0.1, where its front begins."""
    points = [*line("dual", 1.0, [0.1, 0.01]), Point("paper", "a", 20, 0.1), Point("paper", "b", 800, 0.01)]
    paper = judge(points, ["dual", "paper"]).comparisons[0]
    assert paper.lowest_ratio == pytest.approx(2.0)
    assert paper.highest_ratio == pytest.approx(8.0)


def test_levels_are_round_and_few() -> None:
    assert round_levels([0.7, 0.03]) == pytest.approx([0.5, 0.2, 0.1, 0.05])
    assert len(round_levels([1.0, 1e-6])) <= 7
    assert round_levels([0.031, 0.03]) == [0.031]
    assert round_levels([]) == []
