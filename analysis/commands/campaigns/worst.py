"""perilune worst: the worst that a campaign's draws allow, of a metric or of a loop's margin."""

from __future__ import annotations

import argparse
from dataclasses import replace
from typing import Any

from ...api.samples.plans import commands_of
from ...targets import Results, check_folder
from ...worst.asked import check_options, margin_asked
from ...worst.outcome import WorstResult
from ...worst.study import MARGIN, worst_case, worst_margin
from ..common.options import check_json, system_options, tell
from ..common.remarks import say_stale
from ..common.requirements import check_requirements, read_requirements
from ..common.sample_plans import held, read_samples

NUMBERS = ("worst", "random", "fresh_worst", "fresh_quantile", "flights")


def run(options: argparse.Namespace) -> int:
    check_folder("--output", options.output, overwrite=options.overwrite)
    check_json(options)
    check_options(options.loop, vars(options))
    requirements = read_requirements(options.require, NUMBERS)
    files = Results()
    result = _worst_case(options) if options.loop is None else _worst_margin(options)
    files.write(options.output, result.write)
    status = tell(result.document(options.output), options, lambda: print(result.text(options.output)), files)
    met = check_requirements(requirements, result.values())
    return status or int(not met)


def _worst_case(options: argparse.Namespace) -> WorstResult:
    plan = read_samples(options)
    say_stale(options, [fmu for fmus in plan.campaign.compare.values() for fmu in fmus])
    return replace(worst_case(plan, options.metric, **_search(options)), again=commands_of(plan).replay)


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
