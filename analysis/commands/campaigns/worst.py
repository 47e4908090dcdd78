"""perilune worst: the worst that a campaign's draws allow, of a metric or of a loop's margin."""

from __future__ import annotations

import argparse
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from ...api.samples.plans import commands_of
from ...campaigns.spec.plan import BatchPlan
from ...common.targets import PAGES, Results, check_file, check_folder
from ...studies.worst.outcome import WorstResult
from ...studies.worst.request import check_options, margin_asked
from ...studies.worst.study import MARGIN, worst_case, worst_margin
from ..common.options import check_json, system_options, tell
from ..common.remarks import say_stale
from ..common.requirements import check_requirements, read_requirements
from ..common.sample_plans import held, read_samples

NUMBERS = ("worst", "random", "fresh_worst", "fresh_quantile", "flights")


def run(options: argparse.Namespace) -> int:
    check_folder("--output", options.output, overwrite=options.overwrite)
    check_file("--report", options.report, PAGES)
    check_json(options)
    check_options(options.loop, vars(options))
    requirements = read_requirements(options.require, NUMBERS)
    files = Results()
    plan = None if options.loop is not None else _read_plan(options)
    result = _worst_margin(options) if plan is None else _worst_case(plan, options)
    files.write(options.output, result.write)
    files.write(options.report, partial(_write_page, result, plan, options.output))
    status = tell(result.document(options.output), options, lambda: print(result.text(options.output)), files)
    met = check_requirements(requirements, result.values())
    return status or int(not met)


def _read_plan(options: argparse.Namespace) -> BatchPlan:
    plan = read_samples(options)
    say_stale(options, [fmu for fmus in plan.campaign.compare.values() for fmu in fmus])
    return plan


def _worst_case(plan: BatchPlan, options: argparse.Namespace) -> WorstResult:
    return replace(worst_case(plan, options.metric, **_search(options)), again=commands_of(plan).replay)


def _write_page(result: WorstResult, plan: BatchPlan | None, folder: Path | None, path: Path) -> None:
    from ...reports.studies.worst_flight import worst_flight  # and matplotlib, which takes half a second
    from ...reports.studies.worst_page import write_worst_page

    flight, figures = (None, []) if plan is None else worst_flight(result, plan)
    write_worst_page(result, path, flight, figures, folder)


def _worst_margin(options: argparse.Namespace) -> WorstResult:
    asked = margin_asked(
        options.system,
        system_options(options),
        campaign=options.campaign,
        loop=options.loop,
        point=options.point,
        at=options.at,
        seed=options.seed,
    )
    say_stale(options)
    return worst_margin(asked, options.margin or MARGIN, **_search(options))


def _search(options: argparse.Namespace) -> dict[str, Any]:
    """The box, the flights, the noise, and what is held."""
    given = {name: getattr(options, name) for name in ("sigmas", "flights", "realisations", "quantile")}
    return {name: value for name, value in given.items() if value is not None} | held(options)
