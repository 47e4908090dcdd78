"""perilune batch: a campaign of many flights."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from ...campaigns.fly.cluster.connection import cluster
from ...campaigns.fly.runner import open_campaign, run_batch
from ...campaigns.fly.workers.flyer import Flyer, TrialResult
from ...campaigns.spec.checks import check_plan
from ...campaigns.spec.plan import BatchPlan, read_plan
from ...campaigns.spec.sweeps import part_sweeps
from ...campaigns.tables import faults_line
from ...common.errors import InputError
from ...common.targets import PAGES, Results, check_file, check_folder
from ...runtime.flight.interruptible import StuckError
from ..common.exit_status import ExitStatus, exit_status
from ..common.in_flight import series, watch
from ..common.options import check_json, faults, json_number, pairs, system_options, write_json
from ..common.remarks import say_stale
from . import sensitivity
from .telling import asked_requirements, outcome_lines, said_how_to_go_on, tell


def run(options: argparse.Namespace) -> int:
    if options.sensitivity is not None:
        return sensitivity.run(options)
    sensitivity.refuse_alone(options)
    compare = None
    if options.compare is not None:
        found = pairs(options.compare, "--compare", "SLOT=A,B,C")
        compare = {slot: [name.strip() for name in names.split(",")] for slot, names in found.items()}
    _refuse_what_does_not_go_together(options)
    anything = options.overwrite or options.resume or options.replay is not None
    check_folder("--output", options.output, overwrite=anything, otherwise="--resume to go on, or --overwrite")
    check_file("--report", options.report, PAGES)
    check_json(options)
    asked, sweeps = part_sweeps(system_options(options))
    plan = read_plan(
        options.system,
        options.campaign,
        asked,
        trials=options.trials,
        seed=options.seed,
        compare=compare,
        faults=faults(options),
        series=series(options),
        watch=watch(options),
        until_decided=options.until_decided,
        draws=options.draws,
        sweeps=sweeps,
    )
    say_stale(options, [fmu for fmus in plan.campaign.compare.values() for fmu in fmus])
    if options.replay is not None:
        for name in ("require", "report"):
            if getattr(options, name):
                raise InputError("--replay", f"--{name}", "does not go with a replay", "leave one of them out")
        return _replay(plan, options)
    if options.prepare:
        return _prepare(plan, options)
    files = Results()
    requirements = asked_requirements(plan, options.require)
    workers, engine = options.workers, options.engine
    with (
        said_how_to_go_on(options.output),
        cluster(options.scheduler, workers=workers, engine=engine) as elsewhere,
    ):
        result = run_batch(
            plan, workers=workers, output=options.output, resume=options.resume, engine=engine, elsewhere=elsewhere
        )
    if options.output is not None:
        files.written.append(options.output)
    return tell(result, options, requirements, files)


def _refuse_what_does_not_go_together(options: argparse.Namespace) -> None:
    for name in ("resume", "prepare"):
        if getattr(options, name) and options.output is None:
            raise InputError(f"--{name}", "", "there is no folder to do it in", "give --output DIR")
        if getattr(options, name) and options.replay is not None:
            raise InputError(f"--{name}", "--replay", "does not go with it", "leave one of them out")
    if options.until_decided and options.replay is not None:
        raise InputError("--until-decided", "--replay", "does not go with it", "leave one of them out")
    if options.scheduler is not None and options.replay is not None:
        raise InputError("--scheduler", "--replay", "does not go with it", "leave one of them out")
    for name in ("report", "require", "json", "workers", "engine", "scheduler"):
        if options.prepare and getattr(options, name) not in (None, []):
            remedy = (
                "give it to perilune shard"
                if name in ("workers", "engine", "scheduler")
                else "give it to perilune merge"
            )
            raise InputError("--prepare", f"--{name}", "nothing flies yet", remedy)
    if options.resume and options.overwrite:
        raise InputError("--resume", "--overwrite", "one keeps what is there, one does not", "leave one of them out")


def _prepare(plan: BatchPlan, options: argparse.Namespace) -> int:
    """Write what flies, and say how its shards are flown."""
    campaign = open_campaign(plan, options.output, resume=options.resume)
    last = campaign.numbering.count - 1
    print(f"written: {options.output}, shards 0-{last} of {campaign.numbering.size} trials and the rest")
    print(f"fly them: perilune shard {options.output} 0-{last}, in any parts; then: perilune merge {options.output}")
    return ExitStatus.MET


def _replay(plan: BatchPlan, options: argparse.Namespace) -> int:
    """Fly one trial of every variant again, every signal recorded."""
    trial = options.replay
    if not 0 <= trial < plan.campaign.trials:
        raise InputError("--replay", str(trial), "no such trial", f"give 0 to {plan.campaign.trials - 1}")
    check_plan(plan)
    files = Results()
    flyer = Flyer(plan)
    document: dict[str, dict[str, Any]] = {}
    outcomes: dict[str, TrialResult] = {}
    for variant in flyer.variants:
        try:
            result, found = flyer.replay(variant, trial)
        except StuckError as error:
            print(f"perilune: {variant}: trial {trial}: {error}; nothing of it is written", file=sys.stderr)
            return ExitStatus.NOT_MET
        if options.output is not None:
            files.write(options.output / f"{variant}_{trial:06d}.parquet", result.write)
        metrics = {name: json_number(value) for name, value in found.metrics.items()}
        outcomes[variant] = found
        document[variant] = {"status": found.status, "success": found.success, "metrics": metrics}
        if not found.success:
            reason = found.message or f"{plan.campaign.success.text} is not so"
            print(f"perilune: {variant}: trial {trial}: no success: {reason}", file=sys.stderr)
    flown = [str(fault) for fault in plan.faults_of(trial) if fault is not None]
    declared = {"faults": flown} if plan.fault_texts() else {}
    if not write_json({"trial": trial, **declared, "variants": document}, options.json, files):
        for variant, outcome in outcomes.items():
            print("\n".join(outcome_lines(variant, trial, outcome, plan.campaign.metrics)))
        if flown:
            print(faults_line(flown))
    if options.json != "-":
        files.say()
    return exit_status(files, *(entry["success"] for entry in document.values()))
