"""The figures of the bench, as rows and as text."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median
from typing import Any

from .measure import Costs
from .subjects import ITERATIONS


def row_of(material: str, dimension: int, costs: Costs) -> dict[str, Any]:
    """One row of the report."""
    marginal, least = costs.marginal(), costs.marginal(min)
    return {
        "material": material,
        "dims": dimension,
        "solver": costs.variant,
        "particles": costs.particles,
        "iterations": costs.used[0],
        "ns_per_particle_iteration": None if marginal is None else 1e9 * marginal,
        "ns_per_particle_iteration_min": None if least is None else 1e9 * least,
        "ns_per_particle_step_fixed": 1e9 * costs.fixed(),
        "ns_per_particle_step_fixed_min": 1e9 * costs.fixed(min),
        "million_particle_iterations_per_second": costs.used[0] * costs.particles / median(costs.few) / 1e6,
        "million_particle_iterations_per_second_max": costs.used[0] * costs.particles / min(costs.few) / 1e6,
        "million_particle_iterations_per_second_in_iterate": costs.used[0] * costs.particles / median(costs.few_solve) / 1e6,
        "ms_per_step": 1e3 * median(costs.few),
        "bytes_per_particle": costs.bytes_per_particle,
    }


def ratios_of(material: str, dimension: int, all_costs: Sequence[Costs]) -> list[dict[str, Any]]:
    """The dual solver's costs over those of the paper's, measured in turns."""
    by_name = {costs.variant: costs for costs in all_costs}
    paper = by_name.get("paper")
    found: list[dict[str, Any]] = []
    for name in ("dual", "dual-cells"):
        dual = by_name.get(name)
        if paper is None or dual is None:
            continue
        own, other = dual.marginal(), paper.marginal()
        found.append(
            {
                "material": material,
                "dims": dimension,
                "solver": name,
                "iteration": own / other if own is not None and other else None,
                "solve": min(dual.few_solve) / min(paper.few_solve),  # shares of wall time: the least are least disturbed
                "step": median(a / b for a, b in zip(dual.few, paper.few)),
            }
        )
    return found


_COLUMNS = (
    ("ns_per_particle_iteration", "ns/iteration", "{:.1f}"),
    ("ns_per_particle_iteration_min", "least", "{:.1f}"),
    ("ns_per_particle_step_fixed", "ns/step", "{:.0f}"),
    ("ns_per_particle_step_fixed_min", "least", "{:.0f}"),
    ("million_particle_iterations_per_second", "M/s", "{:.1f}"),
    ("million_particle_iterations_per_second_max", "most", "{:.1f}"),
    ("million_particle_iterations_per_second_in_iterate", "M/s solve", "{:.1f}"),
    ("ms_per_step", "ms/step", "{:.1f}"),
    ("bytes_per_particle", "bytes", "{:.0f}"),
)


def text_of(report: dict[str, Any]) -> str:
    """Tables and ratios for a person."""
    machine = report["machine"]
    lines = [
        f"{machine['cpu']}, {machine['isa']}, one thread"
        + ("" if report["core"] is None else f" on core {report['core']}")
        + f", {'; '.join(report['compilers'])}, {machine['date']}",
        f"Per particle: ns of an iteration without what starts a step, ns of a step without its {ITERATIONS} iterations, million"
        " particle-iterations per second of the whole step and of its iterations alone; medians, and the least or most, of"
        f" {report['rounds']} rounds; CPU time.",
    ]
    for key in dict.fromkeys((row["material"], row["dims"]) for row in report["rows"]):
        rows = [row for row in report["rows"] if (row["material"], row["dims"]) == key]
        lines += ["", f"{key[0]} {key[1]}D, {rows[0]['particles']} particles", *_table(rows)]
    for ratio in report["ratios"]:
        each = "-" if ratio["iteration"] is None else f"{ratio['iteration']:.2f}"
        lines.append(
            f"\n{ratio['solver']} iteration / paper's iteration, {ratio['material']} {ratio['dims']}D: {each}; all {ITERATIONS}"
            f" with their start: {ratio['solve']:.2f}; whole step: {ratio['step']:.2f}"
        )
    return "\n".join(lines)


def _table(rows: list[dict[str, Any]]) -> list[str]:
    lines = [["solver", *(title for _, title, _ in _COLUMNS)]]
    lines += [[row["solver"], *(_cell(row[name], form) for name, _, form in _COLUMNS)] for row in rows]
    widths = [max(len(line[column]) for line in lines) for column in range(len(lines[0]))]
    return ["  " + "  ".join([line[0].ljust(widths[0]), *(c.rjust(w) for c, w in zip(line[1:], widths[1:]))]) for line in lines]


def _cell(value: float | None, form: str) -> str:
    return "-" if value is None else form.format(value)
