"""What studies that choose a campaign's draws themselves were asked for on the command line."""

from __future__ import annotations

import argparse
from typing import Any

from ...campaigns.spec.plan import BatchPlan, read_plan
from ...common.errors import InputError
from .in_flight import series, watch
from .options import faults, pairs, system_options


def read_samples(options: argparse.Namespace) -> BatchPlan:
    """The plan of a parsed command line. Raises InputError."""
    compare = None
    if options.compare is not None:
        compare = {slot: [fmu] for slot, fmu in pairs(options.compare, "--compare", "SLOT=FMU").items()}
    return read_plan(
        options.system,
        options.campaign,
        system_options(options),
        seed=options.seed,
        compare=compare,
        faults=faults(options),
        series=series(options),
        watch=watch(options),
    )


def held(options: argparse.Namespace) -> dict[str, Any]:
    """What of the draws is held, and the noise, as studies take it. Raises InputError."""
    found = {}
    for name, text in pairs(options.hold, "--hold", "NAME=VALUE").items():
        try:
            found[name] = float(text)
        except ValueError as error:
            raise InputError("--hold", name, f"{text!r} is not a number", "give a number") from error
    return {"hold": found, "noise_trial": options.noise_trial, "workers": options.workers}
