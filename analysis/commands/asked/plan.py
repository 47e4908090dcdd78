"""The options of perilune plan."""

from __future__ import annotations

import argparse

from .plans import hover_transfer, landing_bound

PLANS = {"hover-transfer": hover_transfer, "landing-bound": landing_bound}


def add(parser: argparse.ArgumentParser) -> None:
    plans = parser.add_subparsers(dest="plan", required=True, metavar="PLAN", parser_class=type(parser))
    for name, module in PLANS.items():
        module.add(plans.add_parser(name, help=module.HELP, description=module.HELP))
