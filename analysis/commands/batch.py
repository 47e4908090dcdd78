"""perilune batch: a campaign of many flights."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from typing import Any

import numpy as np

from ..batch.flyer import Flyer
from ..batch.results import BatchResult
from ..batch.runner import run_batch
from ..batch.status_texts import worst_statuses
from ..batch.summary import TrialColumns, requirement_values, summarise
from ..batch.tables import aligned, faults_line
from ..campaign.expressions import Expression
from ..campaign.plan import BatchPlan, check_plan, read_plan
from ..errors import InputError
from ..flight.interruptible import StuckError
from ..flight.results import TIMED_OUT
from ..reports.batch.batch_report import write_batch_report
from ..system.status_words import with_meaning
from ..targets import PAGES, Results, check_file, check_folder
from .batches import sensitivity
from .common.in_flight import series, watch
from .common.options import check_json, faults, json_number, pairs, system_options, write_json
from .common.remarks import say_stale
from .common.requirements import check_requirements, read_requirements


def run(options: argparse.Namespace) -> int:
    if options.sensitivity is not None:
        return sensitivity.run(options)
    sensitivity.refuse_alone(options)
    compare = None
    if options.compare is not None:
        found = pairs(options.compare, "--compare", "SLOT=A,B,C")
        compare = {slot: [name.strip() for name in names.split(",")] for slot, names in found.items()}
    check_folder("--output", options.output, overwrite=options.overwrite or options.replay is not None)
    check_file("--report", options.report, PAGES)
    check_json(options)
    plan = read_plan(
        options.system,
        options.campaign,
        system_options(options),
        trials=options.trials,
        seed=options.seed,
        compare=compare,
        faults=faults(options),
        series=series(options),
        watch=watch(options),
        draws=options.draws,
    )
    say_stale(options, [fmu for fmus in plan.campaign.compare.values() for fmu in fmus])
    if options.replay is not None:
        for name in ("require", "report"):
            if getattr(options, name):
                raise InputError("--replay", f"--{name}", "does not go with a replay", "leave one of them out")
        return _replay(plan, options)
    files = Results()
    requirements = _requirements(plan, options.require)
    result = run_batch(plan, workers=options.workers, output=options.output)
    if not write_json(result.document(), options.json, files):
        print(result.text())
        for line in _meanings(plan, result):
            print(line)
    files.write(options.output, result.write)
    files.write(options.report, lambda path: write_batch_report(result, path, result.provenance["system"]))
    if options.json != "-":
        files.say()
    for variant, trials in result.trials.items():
        for trial, message in list(trials.messages.items())[:1]:
            print(
                f"perilune: {variant}: {len(trials.messages)} flights failed; trial {trial}: {message}", file=sys.stderr
            )
    late = timed_out(result)
    for variant, count in late.items():
        limit = f"{plan.watch.timeout:g} s of --timeout"
        print(f"perilune: {variant}: {count} flights took longer than the {limit}; give them longer", file=sys.stderr)
    values = requirement_values(result.summary)
    # a status that no trial had is not in the summary: it counts 0
    values |= {name: 0.0 for requirement in requirements for name in requirement.names - set(values)}
    met = check_requirements(requirements, values)
    if result.interrupted:
        flown, planned = result.plan.campaign.trials, plan.campaign.trials
        print(f"perilune: interrupted: the first {flown} of {planned} trials were flown", file=sys.stderr)
    return 2 if files.failed else 0 if met and not result.interrupted and not late else 1


def _meanings(plan: BatchPlan, result: BatchResult) -> list[str]:
    """What each status that a trial reported means, once, as its FMU says."""
    found: dict[str, None] = {}
    for variant in plan.campaign.variants():
        texts = dict.fromkeys(text for text in result.trials[variant.name].statuses if worst_statuses(text))
        if texts:
            network = plan.prepare(variant).network
            seen = {item: None for text in texts for item in worst_statuses(text).items()}
            found |= {with_meaning(network, *item): None for item in seen}
    return list(found)


def _requirements(plan: BatchPlan, texts: list[str]) -> list[Expression]:
    """Requirements; those on numbers that the summary will not have are refused before anything flies."""
    nothing = np.full(1, np.nan)
    blank = TrialColumns([""], np.zeros(1, dtype=bool), {metric.name: nothing for metric in plan.campaign.metrics})
    variants = [variant.name for variant in plan.campaign.variants()]
    groups = [replace(group, trials=np.zeros(1, dtype=int)) for group in plan.groups]
    known = requirement_values(summarise(dict.fromkeys(variants, blank), plan.campaign.metrics, groups))
    statuses = tuple(f"{name.removesuffix('.trials')}.statuses." for name in known if name.endswith(".trials"))
    return read_requirements(texts, known, statuses)


def timed_out(result: BatchResult) -> dict[str, int]:
    """How many flights of each variant took longer than they may; those without any are left out."""
    counts = {
        variant: sum(status.startswith(TIMED_OUT) for status in trials.statuses)
        for variant, trials in result.trials.items()
    }
    return {variant: count for variant, count in counts.items() if count}


def _replay(plan: BatchPlan, options: argparse.Namespace) -> int:
    """Fly one trial of every variant again, every signal recorded."""
    trial = options.replay
    if not 0 <= trial < plan.campaign.trials:
        raise InputError("--replay", str(trial), "no such trial", f"give 0 to {plan.campaign.trials - 1}")
    check_plan(plan)
    files = Results()
    flyer = Flyer(plan)
    files = Results()
    document: dict[str, dict[str, Any]] = {}
    for variant in flyer.variants:
        try:
            result, found = flyer.replay(variant, trial)
        except StuckError as error:
            print(f"perilune: {variant}: trial {trial}: {error}; nothing of it is written", file=sys.stderr)
            return 1
        if options.output is not None:
            files.write(options.output / f"{variant}_{trial:06d}.parquet", result.write)
        metrics = {name: json_number(value) for name, value in found.metrics.items()}
        document[variant] = {"status": found.status, "success": found.success, "metrics": metrics}
    flown = [str(fault) for fault in plan.faults_of(trial) if fault is not None]
    declared = {"faults": flown} if plan.fault_texts() else {}
    if not write_json({"trial": trial, **declared, "variants": document}, options.json, files):
        for variant, entry in document.items():
            print(f"{variant}: trial {trial}: {entry['status']}, {'success' if entry['success'] else 'no success'}")
            units = {metric.name: "" if metric.unit == "1" else metric.unit for metric in plan.campaign.metrics}
            cells = [
                [f"  {name}", "none" if value is None else f"{value:.6g}", units[name]]
                for name, value in entry["metrics"].items()
            ]
            for line in aligned(cells) if cells else ():
                print(line.rstrip())
        if flown:
            print(faults_line(flown))
    if options.json != "-":
        files.say()
    return 2 if files.failed else 0
