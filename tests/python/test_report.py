"""Pareto fronts, verdicts, and the page that shows them."""

from __future__ import annotations

import math
import re
import struct
from pathlib import Path
from typing import Any

import pytest

from browser import browser, open_page
from pbmpm._library import library_path
from pbmpm.lab.report.accuracy_page import save_accuracy_page
from pbmpm.lab.report.build import compilers
from pbmpm.lab.report.case_chart import accuracy_figure
from pbmpm.lab.report.pareto import Point, axis_span, cost_of, front_of
from pbmpm.lab.report.rows import cases_of, verdicts_of
from pbmpm.lab.report.verdict import GOOD, LEVELS, judge, round_levels
from pbmpm.lab.report.words import error_text, shortfalls, verdict_table


def line(solver: str, factor: float, errors: list[float]) -> list[Point]:
    """Settings whose error falls as 1 / cost: error * cost = factor."""
    return [Point(solver, f"{error:g}", factor / error, error) for error in errors]


def test_front_keeps_what_nothing_beats() -> None:
    points = [
        Point("a", "dear", 9, 0.1),
        Point("a", "cheap", 1, 0.5),
        Point("b", "beaten", 2, 0.6),
        Point("b", "ok", 3, 0.2),
    ]
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
    points = [*dual, *line("paper", 4.0, [0.6, 0.001]), *line("explicit", 20.0, [0.3, 0.001])]
    verdict = judge(points, ["dual", "paper", "explicit"])
    paper, explicit = verdict.comparisons
    assert (verdict.highest, verdict.lowest) == pytest.approx((GOOD, GOOD / 10))
    assert paper.ratios == pytest.approx([4.0] * LEVELS)
    assert explicit.median == pytest.approx(20.0)
    assert verdict.best_error == pytest.approx(0.001)
    assert verdict.alone_on_front and verdict.passed and verdict.always


def test_verdict_of_a_solver_that_is_not_cheap_enough() -> None:
    points = [
        *line("primal", 1.0, [0.5, 0.001]),
        *line("paper", 2.0, [0.5, 0.001]),
        *line("explicit", 20.0, [0.5, 0.001]),
    ]
    verdict = judge(points, ["primal", "paper", "explicit"])
    assert verdict.comparisons[0].median == pytest.approx(2.0)
    assert not verdict.comparisons[0].reached
    assert verdict.comparisons[1].reached
    assert verdict.alone_on_front and not verdict.passed


def test_verdict_names_others_on_the_front() -> None:
    points = [*line("dual", 1.0, [0.04, 0.01]), Point("paper", "cheap", 0.5, 0.05)]
    verdict = judge(points, ["dual", "paper", "explicit"])
    assert verdict.solvers_on_front == ("paper", "dual")
    assert not verdict.passed


def test_cheap_answers_that_are_not_good_do_not_count() -> None:
    """The paper's cheapest is on the front, but worse than what is called good."""
    points = [*line("dual", 1.0, [0.5, 0.01]), Point("paper", "cheap", 0.5, 0.051), *line("paper", 9.0, [0.04, 0.01])]
    verdict = judge([*points, *line("explicit", 99.0, [0.5, 0.01])], ["dual", "paper", "explicit"])
    assert verdict.front[0].solver == "paper"
    assert verdict.solvers_on_front == ("dual",) and verdict.passed


def test_errors_far_below_good_do_not_count() -> None:
    """The paper's solver meets the truth by luck, far below the decade that is looked at."""
    points = [*line("dual", 1.0, [0.5, 0.001]), *line("paper", 9.0, [0.5, 0.001]), Point("paper", "luck", 9500.0, 1e-7)]
    paper = judge(points, ["dual", "paper"]).comparisons[0]
    assert min(paper.ratios) > 3.0 and paper.always


def test_verdict_when_the_other_goes_further() -> None:
    """The accelerated stop at 0.02; the paper's reaches 0.001. They are compared from 0.05 to 0.02."""
    verdict = judge([*line("dual", 1.0, [0.5, 0.02]), *line("paper", 1.0, [0.5, 0.001])], ["dual", "paper"])
    paper, explicit = verdict.comparisons
    assert (verdict.highest, verdict.lowest, paper.best_error) == pytest.approx((0.05, 0.02, 0.001))
    assert paper.ratios == pytest.approx([1.0] * LEVELS)
    assert not explicit.measured and not explicit.reached
    assert verdict.solvers_on_front == ("dual", "paper")


def test_verdict_where_good_is_not_reached() -> None:
    """They are still compared, at the best that the accelerated reach, but that is no success."""
    points = [*line("dual", 1.0, [0.5, 0.1]), *line("paper", 30.0, [0.5, 0.1]), *line("explicit", 30.0, [0.5, 0.1])]
    verdict = judge(points, ["dual", "paper", "explicit"])
    assert [item.ratios for item in verdict.comparisons] == [pytest.approx((30.0,))] * 2
    assert not verdict.good_reached and not verdict.passed


def test_an_error_below_that_of_the_converged_solution_counts_as_that() -> None:
    """The explicit solver meets the truth closer than the grid warrants, at a price; the primal is as good as its grid."""
    points = [*line("primal", 1.0, [0.5, 0.03]), *line("explicit", 20.0, [0.5, 0.01])]
    assert judge(points, ["primal", "explicit"]).solvers_on_front == ("primal", "explicit")
    verdict = judge(points, ["primal", "explicit"], converged=0.03)
    assert verdict.solvers_on_front == ("primal",) and verdict.lowest == 0.03
    assert [point.solver for point in verdict.front] == ["primal", "primal", "explicit"]
    # Costs are read from what was measured.
    assert verdict.comparisons[1].ratios == pytest.approx([20.0] * LEVELS)
    lucky = judge([*points, *line("paper", 9.0, [0.5, 0.01])], ["primal", "explicit", "paper"], converged=0.2)
    assert lucky.lowest == GOOD and lucky.alone_on_front and all(item.reached for item in lucky.comparisons)
    assert not lucky.passed and "grid too coarse: converged solutions are not good" in shortfalls(lucky)


def test_verdict_over_the_errors_below_the_one_that_is_called_good() -> None:
    """The paper's costs 2 times as much at 0.1 and 8 times at 0.01: the median is that of the middle, 4 times."""
    points = [*line("dual", 1.0, [0.1, 0.01, 0.005]), Point("paper", "a", 20, 0.1), Point("paper", "b", 800, 0.01)]
    paper = judge(points, ["dual", "paper"], good=0.1).comparisons[0]
    assert paper.ratios[0] == pytest.approx(2.0) and paper.ratios[-1] == pytest.approx(8.0)
    assert paper.median == pytest.approx(4.0)
    assert paper.reached and not paper.always
    points[-1] = Point("paper", "b", 400, 0.01)
    paper = judge(points, ["dual", "paper"], good=0.1).comparisons[0]
    assert max(paper.ratios) > 3.0 > paper.median and not paper.reached


def test_errors_that_the_other_does_not_reach_are_infinitely_dear() -> None:
    """The paper's ends a third of the way down the decade."""
    points = [*line("dual", 1.0, [0.1, 0.01]), *line("paper", 1.0, [0.1, 0.05])]
    paper = judge(points, ["dual", "paper"], good=0.1).comparisons[0]
    assert paper.ratios[0] == pytest.approx(1.0) and paper.median == math.inf
    assert paper.reached and not paper.always


def test_what_a_solver_that_was_cut_short_does_not_reach_costs_at_least_its_best() -> None:
    """The explicit solver's stable settings were too dear to measure; of the paper's, those below 0.03."""
    points = [*line("primal", 1.0, [0.5, 0.001]), *line("paper", 4.0, [0.5, 0.03])]
    paper, explicit = judge(points, ["primal", "paper", "explicit"], cut_short=["paper", "explicit"]).comparisons
    # Down to 0.03 four times dearer. At 0.005 the primal costs 200, the paper's best 4 / 0.03 = 133.
    assert paper.at_least and len(paper.ratios) == LEVELS
    assert paper.ratios[0] == pytest.approx(4.0) and paper.ratios[-1] == pytest.approx(133.3 / 200.0, rel=1e-3)
    assert not explicit.measured and not explicit.reached
    whole = judge(points, ["primal", "paper", "explicit"]).comparisons[0]
    assert whole.ratios[-1] == math.inf and not whole.at_least


def test_verdict_where_the_other_is_never_stable() -> None:
    verdict = judge(line("dual", 1.0, [0.5, 0.01]), ["dual", "paper", "explicit"])
    assert all(comparison.best_error is None and comparison.always for comparison in verdict.comparisons)
    assert verdict.levels[0].costs["paper"] is None


def test_verdict_without_a_stable_accelerated_setting() -> None:
    verdict = judge(line("paper", 1.0, [0.5, 0.01]), ["dual", "paper"])
    assert verdict.best_error is None and verdict.comparisons[0].median is None
    assert not verdict.passed


def test_levels_are_round_and_few() -> None:
    assert round_levels([0.7, 0.03]) == pytest.approx([0.5, 0.2, 0.1, 0.05])
    assert len(round_levels([1.0, 1e-6])) <= 7
    assert round_levels([0.031, 0.03]) == [0.031]
    assert round_levels([]) == []


MACHINE = {
    "cpu": "a <cpu>",
    "cores": 2,
    "isa": "AVX2",
    "threads": 1,
    "system": "Linux",
    "python": "3",
    "date": "2026-01-01",
}


def row(case: str, solver: str, cost: float | None, error: float | None, stable: bool = True) -> dict[str, Any]:
    return {
        "case": case,
        "solver": solver,
        "rate_hz": 60.0,
        "iterations": 5,
        "cells": 10,
        "cell_m": 0.1,
        "error": error,
        "errors": {"height": error},
        "ms_per_simulated_second": cost,
        "iterations_used": 5.0,
        "stable": stable,
        "reasons": [] if stable else ["it <broke>"],
        "command": f"pbmpm accuracy {case} --solvers {solver}",
    }


@pytest.fixture
def report() -> dict[str, Any]:
    """Two cases: one in which the dual is four and twenty times cheaper, one in which the paper's is better."""
    measure = {"name": "height", "kind": "discretisation", "unit": "%", "meaning": "off", "tolerance": 0.05}
    facts = {"dims": 2, "truth": "theory", "notes": "", "errors": [measure]}
    good = [(2.0, "dual"), (8.0, "paper"), (40.0, "explicit")]
    rows = [row("good", solver, cost * factor, 0.1 / factor) for cost, solver in good for factor in (1.0, 2.0, 4.0)]
    rows += [row("good", "explicit", 1.0, None, stable=False), row("good", "explicit", 1.5, 3.0, stable=False)]
    rows += [row("poor", "dual", 10.0, 0.04), row("poor", "paper", 1.0, 0.04)]
    return {
        "cases": [{"case": name, "title": f"Case {name}", **facts} for name in ("good", "poor")],
        "rows": rows,
        "stable_means": "finite",
        "versions": {"pbmpm": "1.2.3"},
        "machine": MACHINE,
    }


def test_verdicts_of_a_report(report: dict[str, Any]) -> None:
    cases = cases_of(report)
    good, poor = verdicts_of(cases)
    # The dual costs 4 at 0.05 and 8 at its best; the others 4 and 20 times as much.
    assert [comparison.median for comparison in good.verdict.comparisons] == pytest.approx([4.0, 20.0])
    assert good.verdict.passed and not poor.verdict.passed
    text = verdict_table(cases)
    line = r"^good +10 +0\.1 .*5 % to 2.5 % +4x \(4x to 4x\) +20x \(20x to 20x\) +dual +reached$"
    assert re.search(line, text, re.M)
    assert re.search(r"^poor .*0.1x .*below 3x.*not measured.*paper on the front too", text, re.M)
    assert "good, 10 cells: dual, 60 Hz x 5 iterations, cell 0.1 m: 5 % for 4 ms per simulated second; the paper's solver needs 16 ms for that;" in text
    assert "the explicit solver needs 80 ms for that." in text
    assert "1 of 2 cases, on 1 of 2 grids" in text and "on 1 grids at every error" in text


def test_the_floor_of_errors_is_not_that_of_coarse_time_steps(report: dict[str, Any]) -> None:
    """The dual's cheap setting has large time steps, whose converged solution is bad; that of its best one decides, and where
    nobody measured it, nothing is known."""
    cheap, _, best = (item for item in report["rows"] if item["case"] == "good" and item["solver"] == "dual")
    cheap["converged_error"] = 0.09
    unknown = verdicts_of(cases_of(report))[0].verdict
    assert not unknown.too_coarse and unknown.lowest == best["error"] and unknown.passed
    best["converged_error"] = 0.03
    known = verdicts_of(cases_of(report))[0].verdict
    assert not known.too_coarse and known.lowest == 0.03
    best["converged_error"] = 0.08
    assert verdicts_of(cases_of(report))[0].verdict.too_coarse


def test_one_of_several_equally_good_settings_is_enough_for_the_floor(report: dict[str, Any]) -> None:
    """Where two settings share the least error, as two integrators do that end at the same rest, it is enough to know the
    converged solution of either."""
    best = [item for item in report["rows"] if item["case"] == "good" and item["solver"] == "dual"][-1]
    report["rows"].append({**best, "converged_error": 0.03})
    assert verdicts_of(cases_of(report))[0].verdict.lowest == 0.03


def test_each_grid_is_judged_by_itself(report: dict[str, Any]) -> None:
    """On a finer grid the explicit solver is cheap, on a coarser one, on which nothing is compared, the paper's: neither
    says anything about the others."""
    report["cases"][0]["compared_cells"] = [10, 20]
    finer = [{**item, "cells": 20, "cell_m": 0.05} for item in report["rows"] if item["case"] == "good" and item["stable"]]
    for item in finer:
        item["ms_per_simulated_second"] *= 0.1 if item["solver"] == "explicit" else 2.0
    report["rows"] += [*finer, {**row("good", "paper", 0.1, 0.02), "cells": 5}]
    coarse, fine, _ = verdicts_of(cases_of(report))
    assert [(judged.cells, judged.cell_m, judged.verdict.passed) for judged in (coarse, fine)] == [
        (10, 0.1, True),
        (20, 0.05, False),
    ]
    assert fine.verdict.comparisons[1].median == pytest.approx(1.0)
    assert "1 of 2 cases, on 1 of 3 grids" in verdict_table(cases_of(report))


def test_a_solver_that_was_cut_short_on_one_grid_counts_on_the_others(report: dict[str, Any]) -> None:
    report["cases"][0]["cut_short"] = [[20, "explicit"]]
    report["rows"] = [item for item in report["rows"] if item["solver"] != "explicit" or not item["stable"]]
    assert verdicts_of(cases_of(report))[0].verdict.comparisons[1].measured
    report["cases"][0]["cut_short"] = [[10, "explicit"]]
    assert not verdicts_of(cases_of(report))[0].verdict.comparisons[1].measured


def test_claims_have_no_verdict_and_the_page_says_so(report: dict[str, Any], tmp_path: Path) -> None:
    report["cases"][1]["searched"] = False
    report["cases"][0]["left_out"] = ["explicit, 99 Hz: would take 70 s to measure"]
    assert [judged.case.name for judged in verdicts_of(cases_of(report))] == ["good"]
    page = tmp_path / "page.html"
    save_accuracy_page(report, "pbmpm accuracy", "", page)
    text = page.read_text(encoding="utf-8")
    assert "without a verdict: poor" in text and text.count("Verdict at 10 cells: ") == 1
    assert "would take 70 s to measure" in text


def test_a_case_that_is_not_compared_says_why(report: dict[str, Any]) -> None:
    report["cases"][1]["not_compared"] = "it measures something else"
    text = verdict_table(cases_of(report))
    assert "poor: no verdict: it measures something else" in text and "of 1 cases" in text


def test_verdicts_without_a_search_say_so(report: dict[str, Any]) -> None:
    report["cases"][0]["explored"], report["cases"][1]["explored"] = False, True
    text = verdict_table(cases_of(report))
    assert "Few settings" in text and text.rstrip().endswith("say nothing about the solvers: good.")
    report["cases"][0]["explored"] = True
    assert "Few settings" not in verdict_table(cases_of(report))


def test_unstable_settings_are_crosses_and_count_for_nothing(report: dict[str, Any]) -> None:
    judged = verdicts_of(cases_of(report))[0]
    crosses = [trace for trace in accuracy_figure(judged.case).data if trace.name and "not stable" in trace.name]
    assert [len(trace.x) for trace in crosses] == [2]
    # The one without an error is drawn above all others.
    assert max(crosses[0].y) == 2 * 3.0
    assert min(point.cost for point in judged.verdict.front) == 2.0


def test_chart_has_a_front_for_each_grid(report: dict[str, Any]) -> None:
    report["rows"].append({**row("good", "paper", 0.1, 0.001), "cells": 5})
    lines = [trace for trace in accuracy_figure(cases_of(report)[0]).data if trace.mode.startswith("lines")]
    assert [trace.name for trace in lines] == ["front at 5 cells", "front at 10 cells"]
    assert (lines[0].x, min(lines[1].x)) == ((0.1,), 2.0)


def test_points_of_fronts_carry_rate_and_iterations(report: dict[str, Any]) -> None:
    report["rows"][0]["substeps"] = 2
    figure = accuracy_figure(cases_of(report)[0])
    front = next(trace for trace in figure.data if trace.name == "front at 10 cells")
    assert front.text[0] == "60 x 2 x 5" and set(front.text[1:]) == {"60 x 5"}


@pytest.mark.parametrize(
    ("costs", "mark", "span"),
    [
        ([5.0, 80.0], 1000.0, (5.0, 1000.0)),  # as far off as the data are wide
        ([5.0, 20.0], 1000.0, (5.0, 20.0)),
        ([50.0, 80.0], 0.05, (50.0, 80.0)),
        ([50.0], 100.0, (50.0, 100.0)),
        ([5.0, 2000.0], 1000.0, (5.0, 2000.0)),
        ([], 4.0, (4.0, 4.0)),
    ],
)
def test_an_axis_fits_its_data(costs: list[float], mark: float, span: tuple[float, float]) -> None:
    low, high = axis_span(costs, mark)
    assert (1.25 * low, high / 1.25) == pytest.approx(span)


def test_the_legend_of_a_narrow_page_leaves_room_for_the_plot(report: dict[str, Any]) -> None:
    """A line for each entry, and one entry for all crosses."""
    report["rows"] += [{**row("good", "dual", 3.0, 0.2, stable), "cells": 10, "cell_m": 0.01 * number} for number in range(1, 20) for stable in (True, False)]
    figure = accuracy_figure(cases_of(report)[0])
    shown = [trace for trace in figure.data if trace.visible]
    assert sum("not stable" in trace.name for trace in shown) == 1
    assert figure.layout.height - 18.5 * len(shown) - figure.layout.margin.t - figure.layout.margin.b > 250


def test_the_axis_of_a_page_fits_its_data(report: dict[str, Any]) -> None:
    case = cases_of(report)[0]
    costs = [item["ms_per_simulated_second"] for item in case.rows if item["ms_per_simulated_second"] is not None]
    low, high = accuracy_figure(case).layout.xaxis.range
    assert (10**low, 10**high) == pytest.approx(axis_span(costs, 1000.0))


def test_another_solver_that_does_not_get_there_is_told_how_far_it_gets(report: dict[str, Any]) -> None:
    for item in report["rows"]:
        if item["case"] == "good" and item["solver"] == "paper":
            item["error"] = 0.2
    assert "the paper's solver gets to 20 % at best" in verdict_table(cases_of(report))


def test_chart_shows_every_error_of_a_case_but_one_at_a_time(report: dict[str, Any]) -> None:
    case = cases_of(report)[0]
    case.facts["errors"].append({"name": "speed", "kind": "solver", "unit": "m/s", "meaning": "off"})
    for item in case.rows:
        item["errors"]["speed"] = None if item["error"] is None else 7 * item["error"]
    figure = accuracy_figure(case)
    heights = [trace for trace in figure.data if trace.visible]
    speeds = [trace for trace in figure.data if not trace.visible]
    assert [trace.name for trace in heights] == [trace.name for trace in speeds]
    assert speeds[1].y == pytest.approx([7 * value for value in heights[1].y])
    button = figure.layout.updatemenus[0].buttons[1]
    assert button.args[0]["visible"] == [False] * len(heights) + [True] * len(speeds)
    assert button.args[1]["yaxis.title.text"] == "speed [m/s]"
    # Real time and the error called good; the second error calls none so.
    assert (len(figure.layout.shapes), len(button.args[1]["shapes"])) == (2, 1)


def test_error_text() -> None:
    assert error_text(0.0123, "%") == "1.23 %"
    assert error_text(0.0123, "m") == "0.0123 m"
    assert error_text(0.5, "1") == "0.5"
    assert error_text(None, "%") == "-"


def test_library_names_its_compilers() -> None:
    assert any("ISPC" in name for name in compilers(library_path()))


def test_page_needs_nothing_from_outside_and_escapes_text(report: dict[str, Any], tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    save_accuracy_page(report, "pbmpm accuracy", "--quick", page)
    text = page.read_text(encoding="utf-8")
    assert re.findall(r"<(?:script|link|img|iframe)[^>]*(?:src|href)=\"(?!data:)", text) == []
    assert "a &lt;cpu&gt;" in text and "it &lt;broke&gt;" in text and "it <broke>;" not in text
    assert "pbmpm accuracy good --quick" in text
    assert text.count("plotly.js v") == 1


@pytest.mark.skipif(browser() is None, reason="no browser")
def test_page_runs_in_a_browser_without_a_script_error(report: dict[str, Any], tmp_path: Path) -> None:
    page, picture = tmp_path / "page.html", tmp_path / "page.png"
    save_accuracy_page(report, "pbmpm accuracy", "", page)
    document, messages = open_page(page, picture)
    assert messages == []
    assert document.count('class="plotly-graph-div js-plotly-plot"') == 2
    assert struct.unpack(">II", picture.read_bytes()[16:24]) == (1300, 2000)
