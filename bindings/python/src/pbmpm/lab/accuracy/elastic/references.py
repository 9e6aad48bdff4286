"""Published and computed reference data that ship with the package; each file's header says where it is from."""

from __future__ import annotations

import csv
import json
from functools import cache
from importlib import resources
from typing import Any

import numpy as np

from ..measures import Curve

_TUREK_STEADY_FROM = 5.0  # [s], as in the header of the file


def _rows(name: str) -> list[dict[str, str]]:
    """The rows of a CSV file whose header lines begin with #."""
    text = resources.files(__package__).joinpath(f"../../data/{name}").read_text(encoding="utf-8")
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


def _columns(rows: list[dict[str, str]], *names: str) -> list[np.ndarray]:
    return [np.array([float(row[name]) for row in rows]) for name in names]


@cache
def elastica_self_weight() -> Curve:
    """Tip deflection over length, divided by the linear theory's load / 8, against the load q L^3 / (E* I)."""
    rows = [row for row in _rows("beam_elastica_large_deflection.csv") if row["case"] == "self_weight_qL3/EI"]
    load, deflection = _columns(rows, "load_nd", "w_over_L")
    return Curve(np.append(0.0, load), np.append(1.0, deflection / (load / 8.0)))


def elastica_tip(load: float) -> float:
    """Tip deflection over length of an inextensible beam under its own weight; ValueError outside the table.

    The ratio to the linear theory is smooth, so that is what is interpolated.
    """
    curve = elastica_self_weight()
    if not 0.0 <= load <= curve.times[-1]:
        raise ValueError(f"load {load:g} is outside the table, 0 to {curve.times[-1]:g}")
    return load / 8.0 * float(curve.at(np.array([load]))[0])


@cache
def turek_hron_beam() -> tuple[Curve, Curve]:
    """Horizontal and vertical displacement [m] of the tip of the CSM3 beam against time [s]."""
    times, across, up = _columns(_rows("beam_turek_hron_csm3.csv"), "t_s", "ux_m", "uy_m")
    return Curve(times, across), Curve(times, up)


def turek_hron_steady(curve: Curve) -> Curve:
    """The part from which the amplitude is taken."""
    late = curve.times >= _TUREK_STEADY_FROM
    return Curve(curve.times[late], curve.values[late])


@cache
def uniaxial_curve(dimension: int, poisson: float, model: str) -> tuple[Curve, Curve]:
    """First Piola stress over E, and lateral stretch, against axial stretch, for the model "NH" or "FCR".

    ValueError when the table has no such curve.
    """
    rows = [
        row
        for row in _rows("elastic_uniaxial_curves.csv")
        if int(row["dim"]) == dimension and float(row["nu"]) == poisson and row[f"{model}_P"] not in ("", "nan")
    ]
    if not rows:
        raise ValueError(f"no uniaxial curve for {dimension}D, nu = {poisson:g}, model {model}")
    stretch, stress, lateral = _columns(rows, "lambda", f"{model}_P", f"{model}_lat")
    return Curve(stretch, stress), Curve(stretch, lateral)


@cache
def two_discs() -> dict[str, Any]:
    """The set-up of Sulsky, Chen and Schreyer (1994), and figures that follow from it."""
    text = resources.files(__package__).joinpath("../../data/elastic_two_discs.json").read_text(encoding="utf-8")
    return json.loads(text)
