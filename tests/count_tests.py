"""Adds up JUnit reports: ``count_tests.py REPORT...`` prints "N passed, M failed, K skipped"; exit status 1 if one failed.

A Unity executable is one entry in CTest's report but prints how many tests it ran; those are what is counted.
"""

import re
import sys
import xml.etree.ElementTree as ElementTree
from collections import Counter

UNITY_SUMMARY = re.compile(r"^(\d+) Tests (\d+) Failures (\d+) Ignored", re.MULTILINE)


def count_case(case: ElementTree.Element) -> Counter[str]:
    """What one entry of a report stands for."""
    if case.find("skipped") is not None:
        return Counter(skipped=1)
    bad = case.find("failure") is not None or case.find("error") is not None
    summary = UNITY_SUMMARY.search(case.findtext("system-out") or "")
    if not summary:
        return Counter(failed=1) if bad else Counter(passed=1)
    tests, failures, ignored = (int(number) for number in summary.groups())
    counted = Counter(passed=tests - failures - ignored, failed=failures, skipped=ignored)
    if bad and not failures:  # it failed after its summary: a sanitizer's report, or a crash at exit
        counted["failed"] = 1
    return counted


def main(reports: list[str]) -> int:
    total: Counter[str] = Counter()
    for report in reports:
        try:
            cases = list(ElementTree.parse(report).iter("testcase"))
        except (OSError, ElementTree.ParseError) as problem:
            print(f"count_tests: no report {report}: {problem}")
            cases = []
        if not cases:
            total["failed"] += 1
        for case in cases:
            total.update(count_case(case))
    print(f"{total['passed']} passed, {total['failed']} failed, {total['skipped']} skipped")
    return 1 if total["failed"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
