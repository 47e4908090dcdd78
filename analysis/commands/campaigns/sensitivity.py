"""perilune batch --sensitivity N: what drives the metrics of a campaign."""

from __future__ import annotations

import argparse
import sys
from functools import partial
from pathlib import Path

from ...campaign.sweeps import part_sweeps
from ...errors import InputError
from ...sensitivity.outcome import SensitivityResult
from ...sensitivity.study import sensitivity
from ...targets import PAGES, Results, check_file, check_folder
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
    files.write(options.output, result.write)
    files.write(options.report, partial(_write_page, result))
    return tell(result.document(), options, lambda: print(result.text()), files)


def _write_page(result: SensitivityResult, path: Path) -> None:
    from ...reports.studies.sensitivity_page import write_sensitivity_page  # and matplotlib: half a second

    write_sensitivity_page(result, path)


def refuse_alone(options: argparse.Namespace) -> None:
    """Refuse options that go with --sensitivity only."""
    for name, given in (("--hold", options.hold), ("--noise-trial", options.noise_trial)):
        if given:
            text = str(given[0] if isinstance(given, list) else given)
            problem = "a batch draws all of its trials"
            raise InputError(name, text, problem, "give --sensitivity N too, or leave it out")
