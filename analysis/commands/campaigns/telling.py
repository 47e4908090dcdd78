"""What the commands about campaigns say of a result, and their exit status."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...campaigns.fly.manifest.manifest import FILE as MANIFEST
from ...campaigns.fly.replay import stored_replay
from ...campaigns.fly.results import BatchResult
from ...campaigns.fly.workers.flyer import TrialResult
from ...campaigns.fly.workers.status_texts import worst_statuses
from ...campaigns.fly.workers.workers import WorkersDiedError
from ...campaigns.requirement_verdicts import add_verdicts, unmet_lines
from ...campaigns.rows import TrialColumns, TrialRows
from ...campaigns.spec.campaign import Metric
from ...campaigns.spec.expressions import Expression
from ...campaigns.spec.plan import BatchPlan
from ...campaigns.summary import requirement_values, summarise
from ...campaigns.tables import aligned
from ...common.errors import EndedError
from ...common.targets import Results
from ...runtime.flight.results import TIMED_OUT
from ...runtime.system.status_words import with_meaning
from ..common.exit_status import ExitStatus, exit_status
from ..common.options import write_json
from ..common.requirements import check_requirements, read_requirements


@contextmanager
def said_how_to_go_on(folder: Path | None) -> Iterator[None]:
    """What ends a campaign early also says how it is gone on with, if it lies in a folder."""
    place = None if folder is None else folder.absolute()  # an FMU may change the working folder
    try:
        yield
    except KeyboardInterrupt:
        raise EndedError(f"interrupted{_how_to_go_on(place)}", ExitStatus.NOT_MET) from None
    except WorkersDiedError as error:
        raise EndedError(f"{error}{_how_to_go_on(place)}", ExitStatus.NOT_MET) from error
    except OSError as error:
        file = f"{error.filename}: " if error.filename else ""
        raise EndedError(
            f"{file}{error.strerror or error}; make room{_how_to_go_on(place)}", ExitStatus.REFUSED
        ) from error


def _write_page(result: BatchResult, path: Path) -> None:
    from ...reports.campaign.batch_report import write_batch_report  # and matplotlib, which takes half a second

    write_batch_report(result, path, result.provenance["system"])


def _how_to_go_on(folder: Path | None) -> str:
    if folder is None or not (folder / MANIFEST).is_file():
        return ""
    return f"; what is flown lies in {folder}: the same command with --resume goes on, or perilune shard"


def tell(result: BatchResult, options: argparse.Namespace, requirements: list[Expression], files: Results) -> int:
    """Print a result, write its page and JSON as asked; returns the exit status."""
    plan = result.plan
    if not write_json(result.document(), options.json, files):
        print(result.text())
        for line in _meanings(plan, result):
            print(line)
    files.write(options.report, partial(_write_page, result))
    if options.json != "-":
        files.say()
    failures = failed_flights([result.rows])
    report_failed(failures, plan, result.folder)
    late = timed_out(result)
    for variant, count in late.items():
        limit = f"{plan.watch.timeout:g} s of --timeout"
        print(f"perilune: {variant}: {count} flights took longer than the {limit}; give them longer", file=sys.stderr)
    values = requirement_values(result.summary)
    # a status that no trial had is not in the summary: it counts 0
    values |= {name: 0.0 for requirement in requirements for name in requirement.names - set(values)}
    met = check_requirements(requirements, values)
    unmet = unmet_lines(result.summary)
    for line in unmet:
        print(f"perilune: {line}", file=sys.stderr)
    return exit_status(files, met, not unmet, not failures)


class Failures(NamedTuple):
    """Flights of a variant that did not reach their end: how many, the first one's trial and message."""

    flights: int
    trial: int
    message: str


def failed_flights(parts: Iterable[Mapping[str, TrialRows]]) -> dict[str, Failures]:
    """Of each variant that has any; ``parts`` are trials by variant, in order of trial."""
    failures: dict[str, Failures] = {}
    for rows in parts:
        for variant, own in rows.items():
            for columns in own.parts("trial", "message"):
                failed = np.flatnonzero(columns["message"] != "")
                if failed.size:
                    first = Failures(0, int(columns["trial"][failed[0]]), str(columns["message"][failed[0]]))
                    before = failures.get(variant, first)
                    failures[variant] = before._replace(flights=before.flights + failed.size)
    return failures


def report_failed(failures: Mapping[str, Failures], plan: BatchPlan, folder: Path | None) -> None:
    """A line on standard error for each variant, with the command that flies its first failed trial again."""
    variants = plan.campaign.variants()
    for variant, (flights, trial, message) in failures.items():
        replay = "" if folder is None else f"; see it: {stored_replay(folder, variants, variant, trial)}"
        print(f"perilune: {variant}: {flights} flights failed; trial {trial}: {message}{replay}", file=sys.stderr)


def outcome_lines(variant: str, trial: int, outcome: TrialResult, metrics: Iterable[Metric]) -> list[str]:
    """What one trial of a variant came to: its status, whether it is a success, its metrics."""
    success = "success" if outcome.success else "no success"
    cells = []
    for metric in metrics:
        value = outcome.metrics[metric.name]
        text = "none" if math.isnan(value) else f"{value:.6g}"
        cells.append([f"  {metric.name}", text, "" if metric.unit == "1" else metric.unit])
    lines = [line.rstrip() for line in aligned(cells)] if cells else []
    return [f"{variant}: trial {trial}: {outcome.status}, {success}", *lines]


def _meanings(plan: BatchPlan, result: BatchResult) -> list[str]:
    """What each status that a trial reported means, once, as its FMU says."""
    found: dict[str, None] = {}
    for variant in plan.campaign.variants():
        texts = dict.fromkeys(text for text in result.summary[variant.name]["statuses"] if worst_statuses(text))
        if texts:
            network = plan.prepare(variant).network
            seen = {item: None for text in texts for item in worst_statuses(text).items()}
            found |= {with_meaning(network, *item): None for item in seen}
    return list(found)


def asked_requirements(plan: BatchPlan, texts: list[str]) -> list[Expression]:
    """Requirements; those on numbers that the summary will not have are refused before anything flies."""
    nothing = np.full(1, np.nan)
    metrics = {metric.name: nothing for metric in plan.campaign.metrics}
    blank = TrialColumns([""], np.zeros(1, dtype=bool), metrics)
    variants = [variant.name for variant in plan.campaign.variants()]
    columns = dict.fromkeys(variants, blank)
    summary = summarise(columns, plan.campaign.metrics)
    for name in variants if plan.groups else ():
        summary[name]["groups"] = {group.label: {**summary[name], "value": group.value} for group in plan.groups}
    add_verdicts(summary, plan.campaign.requirements, columns)
    known = requirement_values(summary)
    statuses = tuple(f"{name.removesuffix('.trials')}.statuses." for name in known if name.endswith(".trials"))
    return read_requirements(texts, known, statuses)


def timed_out(result: BatchResult) -> dict[str, int]:
    """How many flights of each variant took longer than they may; those without any are left out."""
    counts = {
        variant: sum(count for status, count in entry["statuses"].items() if status.startswith(TIMED_OUT))
        for variant, entry in result.summary.items()
    }
    return {variant: count for variant, count in counts.items() if count}
