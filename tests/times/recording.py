"""Hooks of pytest that write what each test takes to build/test_times.json: wall and processor time (s), children too.

A run of some tests replaces their entries alone.
"""

from __future__ import annotations

import json
import os
from collections import defaultdict
from pathlib import Path
from typing import Any

import pytest

from perilune.common.atomic import write_atomically
from perilune.common.paths import BUILD

TIMES = BUILD / "test_times.json"
_begin: list[float] = []  # processor time (s) at which the current test has begun


def pytest_runtest_logstart() -> None:
    _begin[:] = [_processor_time()]


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Add the processor time where the test ran: a process that only collects reports has it from there."""
    if report.when == "teardown" and "processor" not in dict(report.user_properties):
        report.user_properties.append(("processor", _processor_time() - _begin[0]))


def write_times(terminalreporter: Any) -> None:
    """Write the times of this run's tests, of which pytest's terminal has the reports."""
    times: dict[str, dict[str, float]] = defaultdict(lambda: {"wall": 0.0, "processor": 0.0})
    for reports in terminalreporter.stats.values():
        for report in reports:
            if isinstance(report, pytest.TestReport):
                times[report.nodeid]["wall"] += report.duration
                times[report.nodeid]["processor"] += dict(report.user_properties).get("processor", 0.0)
    if times and BUILD.is_dir():
        files = {path.as_posix() for path in Path("tests").rglob("test_*.py")}
        known = {name: entry for name, entry in read_times(TIMES).items() if name.split("::")[0] in files}
        rounded = {name: {kind: round(number, 3) for kind, number in entry.items()} for name, entry in times.items()}
        write_atomically(TIMES, json.dumps(dict(sorted((known | rounded).items())), indent=0).encode())


def read_times(path: Path = TIMES) -> dict[str, dict[str, float]]:
    """Return wall and processor time (s) by test; empty before the first run."""
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def _processor_time() -> float:
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system
