"""perilune replay: a trial of a stored campaign again, of its folder alone."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

from ...campaigns.fly.replay import ReplayedTrial, replay_trial
from ...campaigns.tables import faults_line
from ...common.targets import PAGES, Results, check_file
from ...reports.figures.declaration.figures import Figure
from ...reports.figures.declaration.reading import read_figures
from ...reports.figures.limits import limit_document
from ...runtime.flight.interruptible import StuckError
from ...runtime.flight.results import Result
from ..common.exit_status import ExitStatus, exit_status
from ..common.flight import check_flight, flight_lines
from ..common.in_flight import watch
from ..common.options import check_json, json_number, write_json
from ..common.requirements import check_requirements, read_requirements
from .telling import outcome_lines

METRIC = "metric."
OUTPUT_SUFFIXES = (".csv", ".parquet")
STUCK = "nothing is written; see what it says with --log all, or give it longer"


def last_values(result: Result) -> dict[str, float]:
    """What requirements on one flight are about: the last values of signals and of time."""
    if not result.time.size:
        return {}
    return {"time": float(result.time[-1]), **{name: float(value) for name, value in result.final().items()}}


def write_page(result: Result, system: str, figures: Sequence[Figure], path: Path) -> None:
    """The page of one flight, which ``system`` heads."""
    from ...reports.flight.run_report import write_run_report  # and matplotlib, which takes half a second

    write_run_report(result, path, system, figures)


def run(options: argparse.Namespace) -> int:
    check_file("--output", options.output, OUTPUT_SUFFIXES)
    check_file("--report", options.report, PAGES)
    check_json(options)
    files = Results()
    asked = watch(options)
    try:
        replayed = replay_trial(
            options.folder, options.trial, options.configuration, log=asked.log, timeout=asked.timeout
        )
    except StuckError as error:
        print(f"perilune: {options.folder}: trial {options.trial}: {error}; {STUCK}", file=sys.stderr)
        return ExitStatus.NOT_MET
    flight, figures = replayed.flight, read_figures(replayed.prepared)
    values = last_values(flight) | {METRIC + name: value for name, value in replayed.outcome.metrics.items()}
    requirements = read_requirements(options.require, values)
    final = {name: json_number(value) for name, value in flight.final().items()}
    document = flight.summary() | replay_facts(replayed)
    document |= {"limits": limit_document(figures, flight), "final": final}
    if not write_json(document, options.json, files):
        print("\n".join([*flight_lines(replayed.prepared, figures, flight), *replay_lines(replayed)]))
    files.write(options.output, flight.write)
    name = f"{replayed.prepared.archive.name}, {replayed.configuration}, trial {replayed.trial}"
    files.write(options.report, partial(write_page, flight, name, figures))
    if options.json != "-":
        files.say()
    finished = check_flight(replayed.prepared, figures, flight)
    if flight.complete and not replayed.outcome.success:
        reason = f"no success: {replayed.plan.campaign.success.text} is not so"
        print(f"perilune: {options.folder}: trial {replayed.trial}: {reason}", file=sys.stderr)
    for difference in replayed.differences:
        remedy = "; another machine, C library or version of Perilune than the campaign's flies it now"
        line = f"{difference}{'' if replayed.is_cut_off else remedy}"
        print(f"perilune: {options.folder}: trial {replayed.trial}: {line}", file=sys.stderr)
    met = check_requirements(requirements, values)
    return exit_status(files, finished, met, replayed.outcome.success, not replayed.differences)


def replay_facts(replayed: ReplayedTrial) -> dict[str, Any]:
    """What the campaign says of the trial, for other programs."""
    return {
        "campaign": replayed.plan.campaign.file,
        "trial": replayed.trial,
        "configuration": replayed.configuration,
        "success": replayed.outcome.success,
        "metrics": {name: json_number(value) for name, value in replayed.outcome.metrics.items()},
        "stored": replayed.stored,
        "differences": list(replayed.differences),
    }


def replay_lines(replayed: ReplayedTrial) -> list[str]:
    """The trial's metrics, its faults, and whether it is what the folder has."""
    metrics = replayed.plan.campaign.metrics
    lines = outcome_lines(replayed.configuration, replayed.trial, replayed.outcome, metrics)
    lines += [faults_line(replayed.faults)] if replayed.faults else []
    if replayed.stored and not replayed.differences:
        lines.append("equal to the stored trial to the last bit")
    return lines
