"""perilune worst: the worst that a campaign's draws allow."""

from __future__ import annotations

import argparse

from ...targets import Results, check_folder
from ...worst.study import FLIGHTS, SIGMAS, worst_case
from ..common.options import check_json, tell
from ..common.remarks import say_stale
from ..common.requirements import check_requirements, read_requirements
from ..common.sample_plans import held, read_samples

NUMBERS = ("worst", "random", "flights")


def run(options: argparse.Namespace) -> int:
    check_folder("--output", options.output, overwrite=options.overwrite)
    check_json(options)
    requirements = read_requirements(options.require, NUMBERS)
    plan = read_samples(options)
    say_stale(options, [fmu for fmus in plan.campaign.compare.values() for fmu in fmus])
    files = Results()
    result = worst_case(
        plan,
        options.metric,
        sigmas=SIGMAS if options.sigmas is None else options.sigmas,
        flights=FLIGHTS if options.flights is None else options.flights,
        **held(options),
    )
    files.write(options.output, result.write)
    status = tell(result.document(), options, lambda: print(result.text()), files)
    met = check_requirements(requirements, result.values())
    return status or int(not met)
