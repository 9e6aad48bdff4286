"""The hard cases of the catalogue, each at its own rate and iterations. Scenes, criteria and limits are defined there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from pbmpm.app.hardcases import CASES, Check, HardCase, Setting, find_case


def _all_settings() -> Iterator[Any]:
    for case in CASES:
        for setting in case.settings():
            reason = case.known_failure(setting)
            # Strict: a case that begins to pass has to leave the list of known failures.
            marks = [pytest.mark.xfail(reason=reason, strict=True, raises=AssertionError)] if reason else []
            yield pytest.param(case, setting, id=f"{case.id}: {setting}", marks=marks)


#: Rates and iterations beside the cases' own, in 2D: from the softest that the law of stiffness lets pass to much stiffer.
OTHER_RATES = (
    ("H01", 60, 5),
    ("H03", 60, 1),
    ("H03", 120, 10),
    ("H03", 240, 2),
    ("H04", 240, 2),
    ("H08", 30, 1),
    ("H08", 240, 2),
    ("H10", 60, 1),
    ("H16", 120, 10),
    ("H17", 15, 1),
    ("H17", 480, 5),
    ("H21", 480, 1),
)


def _other_settings() -> Iterator[Any]:
    for identifier, rate_hz, iterations in OTHER_RATES:
        case = find_case(identifier)
        for setting in case.settings(rate_hz, iterations):
            if setting.dimension == 2:
                yield pytest.param(case, setting, id=f"{identifier}: {setting}")


@pytest.mark.parametrize(("case", "setting"), [*_all_settings(), *_other_settings()])
def test_hard_case(case: HardCase, setting: Setting) -> None:
    outcome = case.run(setting)
    assert outcome.passed, outcome.description


def test_catalogue_is_complete_and_in_order() -> None:
    identifiers = [case.id for case in CASES]
    assert identifiers == ["H01", "H03", "H04", "H05", "H06", "H07", "H08", "H10", "H16", "H17", "H21"]
    assert all(case.title and case.origin and case.criterion for case in CASES)


def test_known_failures_name_settings_that_exist() -> None:
    for case in CASES:
        settings = {(setting.material, setting.dimension, setting.variant) for setting in case.settings()}
        assert set(case.known_failures) <= settings


def test_find_case() -> None:
    assert find_case("h03").id == "H03"
    with pytest.raises(ValueError, match="H99.*H01"):
        find_case("H99")


def test_unknown_variant_is_refused() -> None:
    with pytest.raises(ValueError, match="no variant"):
        CASES[0].run(Setting("liquid", 2, "nonsense", 60.0, 5))


@pytest.mark.parametrize(
    ("figure", "limit", "at_least", "passed"),
    [(1.0, 1.0, False, True), (1.1, 1.0, False, False), (1.1, 1.0, True, True), (0.9, 1.0, True, False)],
)
def test_check_compares_with_its_limit(figure: float, limit: float, at_least: bool, passed: bool) -> None:
    assert Check("figure", figure, limit, at_least).passed is passed


@pytest.mark.parametrize("at_least", [False, True])
def test_check_of_nan_fails(at_least: bool) -> None:
    assert not Check("figure", float("nan"), 1.0, at_least).passed
    assert not Check("figure", float("inf"), 1.0, at_least).passed


def test_outcome_tells_the_check_that_failed() -> None:
    """A press at one iteration cannot bring the volume back in time; the outcome must say so and not crash."""
    case = find_case("H03")
    setting = next(case.settings(rate_hz=15.0, iterations=1))
    outcome = case.run(setting)
    assert not outcome.passed
    assert (outcome.figure, outcome.limit) == (outcome.telling.figure, outcome.telling.limit)
    assert "FAILED" in outcome.description
