"""The options of perilune worst."""

from __future__ import annotations

import argparse

from ...common.options import add_json
from ...common.requirements import add_requirements
from ...common.samples import add_folder, add_samples


def add(parser: argparse.ArgumentParser) -> None:
    add_samples(parser)
    parser.add_argument(
        "--metric",
        metavar="EXPRESSION",
        help="over metrics and draws, the larger the worse; default: the margin by which a trial is no success",
    )
    parser.add_argument("--sigmas", type=float, metavar="K", help="how far normal draws go; default: 3")
    parser.add_argument("--flights", type=int, metavar="N", help="how many to fly; default: 2000")
    add_folder(parser, "worst.json, flights.parquet, and worst.parquet for perilune batch --draws")
    add_requirements(parser, "worst, random and flights")
    add_json(parser)
