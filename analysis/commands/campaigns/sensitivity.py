"""perilune batch --sensitivity N: what drives the metrics of a campaign."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path

from ...api.samples.plans import commands_of
from ...campaigns.spec.sweeps import part_sweeps
from ...common.errors import InputError
from ...common.targets import PAGES, Results, check_file, check_folder
from ...studies.sensitivity.outcome import SensitivityResult
from ...studies.sensitivity.study import sensitivity
from ..common.options import check_json, system_options, tell
from ..common.remarks import say_stale
from ..common.sample_plans import held, read_samples

NOT_WITH = (
    "trials", "draws", "replay", "require", "resume", "prepare", "until_decided", "engine",
    "scheduler",
)  # fmt: skip


def run(options: argparse.Namespace) -> int:
    for name in NOT_WITH:
        value = getattr(options, name)
        if value is not None and value is not False and value != []:
            raise InputError(
                "--sensitivity", f"--{name.replace('_', '-')}", "does not go with it", "leave one of them out"
            )
    for name, text in part_sweeps(system_options(options))[1].items():
        raise InputError("--sensitivity", f"--set {name}={text}", "does not go with a sweep", "give one value")
    check_folder("--output", options.output, overwrite=options.overwrite)
    check_file("--report", options.report, PAGES)
    check_json(options)
    plan = read_samples(options)
    say_stale(options, [fmu for fmus in plan.campaign.compare.values() for fmu in fmus])
    files = Results()
    result = sensitivity(
        plan, options.sensitivity, **held(options), tell=lambda price: print(f"perilune: {price}", file=sys.stderr)
    )
    result = replace(result, commands=commands_of(plan))
    files.write(options.output, result.write)
    files.write(options.report, partial(_write_page, result, options.output))
    return tell(result.document(options.output), options, lambda: print(result.text(options.output)), files)


def _write_page(result: SensitivityResult, folder: Path | None, path: Path) -> None:
    from ...reports.studies.sensitivity_page import write_sensitivity_page  # and matplotlib: half a second

    write_sensitivity_page(result, path, folder)


def refuse_alone(options: argparse.Namespace) -> None:
    """Refuse options that go with --sensitivity only."""
    for name, given in (("--hold", options.hold), ("--noise-trial", options.noise_trial)):
        if given is not None and given != []:
            text = str(given[0] if isinstance(given, list) else given)
            problem = "a batch draws all of its trials"
            raise InputError(name, text, problem, "give --sensitivity N too, or leave it out")
