"""perilune plan: plans of least propellant and what no plan can beat."""

from __future__ import annotations

import argparse
import sys

from ..planning.path import PlanError
from .plans import hover_transfer, landing_bound

PLANS = {"hover-transfer": hover_transfer, "landing-bound": landing_bound}


def add(parser: argparse.ArgumentParser) -> None:
    plans = parser.add_subparsers(dest="plan", required=True, metavar="PLAN", parser_class=type(parser))
    for name, module in PLANS.items():
        module.add(plans.add_parser(name, help=module.HELP, description=module.HELP))


def run(options: argparse.Namespace) -> int:
    try:
        return PLANS[options.plan].run(options)
    except PlanError as problem:
        print(f"perilune: {options.plan}: {problem}", file=sys.stderr)
        return 1
