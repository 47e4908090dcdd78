"""perilune rare: the probability of a rare failure."""

from __future__ import annotations

import argparse
from dataclasses import replace
from functools import partial
from pathlib import Path

from ...api.samples.plans import commands_of
from ...common.targets import PAGES, Results, check_file, check_folder
from ...studies.rare.outcome import RareResult
from ...studies.rare.study import LEAST, SAMPLES, rare_failure
from ..common.options import check_json, tell
from ..common.remarks import say_stale
from ..common.requirements import check_requirements, read_requirements
from ..common.sample_plans import held, read_samples

NUMBERS = ("probability", "interval[1]", "interval[2]", "flights")


def run(options: argparse.Namespace) -> int:
    check_folder("--output", options.output, overwrite=options.overwrite)
    check_file("--report", options.report, PAGES)
    check_json(options)
    requirements = read_requirements(options.require, NUMBERS)
    plan = read_samples(options)
    say_stale(options, [fmu for fmus in plan.campaign.compare.values() for fmu in fmus])
    files = Results()
    result = rare_failure(
        plan,
        options.failure,
        samples=SAMPLES if options.samples is None else options.samples,
        least=LEAST if options.least is None else options.least,
        **held(options),
    )
    result = replace(result, commands=commands_of(plan))
    files.write(options.output, result.write)
    files.write(options.report, partial(_write_page, result, options.output))
    status = tell(result.document(options.output), options, lambda: print(result.text(options.output)), files)
    met = check_requirements(requirements, result.values())
    return status or int(not met)


def _write_page(result: RareResult, folder: Path | None, path: Path) -> None:
    from ...reports.studies.rare_page import write_rare_page  # and matplotlib, which takes half a second

    write_rare_page(result, path, folder)
