"""perilune plan: plans of least propellant and what no plan can beat."""

from __future__ import annotations

import argparse
import sys

from ..design.trajectories.path import PlanError
from .common.exit_status import ExitStatus
from .plans import hover_transfer, landing_bound

PLANS = {"hover-transfer": hover_transfer, "landing-bound": landing_bound}


def run(options: argparse.Namespace) -> int:
    try:
        return PLANS[options.plan].run(options)
    except PlanError as problem:
        print(f"perilune: {options.plan}: {problem}", file=sys.stderr)
        return ExitStatus.NOT_MET
