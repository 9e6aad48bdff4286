#!/usr/bin/env python3
"""Keeps what `pbmpm bench --json` measured as a table, and compares two tables.

    python3 tests/bench/table.py write LABEL REPORT.json... > tests/bench/LABEL.csv
    python3 tests/bench/table.py compare OLD.csv NEW.csv [--columns NAME,...]

A table has a line per row of the reports, in front of it the label and where it was measured. Two tables are compared row by row, where both have the same case; printed are both figures and the new one over
the old one. Figures of two machines compare in units of the peak (`peak_units`), or as ratios to a peer (`ratio`)."""

from __future__ import annotations

import argparse
import csv
import json
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TextIO

ORIGIN = ("label", "cpu", "isa", "compilers", "date")
CASE = ("peer", "material", "dims", "solver", "rate_hz", "iterations", "phase")
"""What tells rows apart; the rest are figures."""
COMPARED = ("ns_per_particle", "ns_per_particle_min", "peak_units", "share_of_peak", "share_of_bandwidth", "ns_per_particle_iteration_min", "ns_per_particle_step_fixed_min", "ratio", "bytes_per_particle")


def rows_of(label: str, reports: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Lines of a table."""
    rows = []
    for report in reports:
        machine = report["machine"]
        origin = (label, machine["cpu"], machine["isa"], "; ".join(report.get("compilers", [])), machine["date"])
        rows += [dict(zip(ORIGIN, origin)) | row for row in report["rows"]]
    return rows


def write_table(rows: Sequence[Mapping[str, Any]], file: TextIO) -> None:
    """Cases first, then every figure that some row has."""
    names = dict.fromkeys(name for row in rows for name in row)
    first = [name for name in (*ORIGIN, *CASE) if name in names]
    writer = csv.DictWriter(file, [*first, *(name for name in names if name not in first)], restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows({name: f"{value:.5g}" if isinstance(value, float) else value for name, value in row.items()} for row in rows)


def read_table(file: TextIO) -> dict[tuple[str, ...], dict[str, str]]:
    """Rows by their case."""
    return {tuple(row.get(name) or "" for name in CASE): row for row in csv.DictReader(file)}


def comparison(old: Mapping[tuple[str, ...], Mapping[str, str]], new: Mapping[tuple[str, ...], Mapping[str, str]], columns: Sequence[str]) -> list[str]:
    """Lines for a person; columns that a row lacks are left out."""
    lines = []
    for case in (case for case in old if case in new):
        for name in columns:
            before, after = (float(table[case].get(name) or "nan") for table in (old, new))
            if before == before and after == after and before != 0.0:
                lines.append(f"{' '.join(part for part in case if part):50} {name:32} {before:10.4g} {after:10.4g} {after / before:6.2f}")
    return lines


def main(words: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True, dest="command")
    write = commands.add_parser("write")
    write.add_argument("label")
    write.add_argument("reports", nargs="+", type=Path)
    compare = commands.add_parser("compare")
    compare.add_argument("old", type=Path)
    compare.add_argument("new", type=Path)
    compare.add_argument("--columns", type=lambda text: text.split(","), default=COMPARED)
    arguments = parser.parse_args(words)
    if arguments.command == "write":
        write_table(rows_of(arguments.label, [json.loads(path.read_text(encoding="utf-8")) for path in arguments.reports]), sys.stdout)
        return
    tables = []
    for path in (arguments.old, arguments.new):
        with path.open(encoding="utf-8", newline="") as file:
            tables.append(read_table(file))
    lines = comparison(*tables, arguments.columns)
    if not lines:
        parser.error("the tables have no case and column in common")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
