"""The options of perilune rare."""

from __future__ import annotations

import argparse

from ...common.options import add_json
from ...common.requirements import add_requirements
from ...common.samples import add_folder, add_report, add_samples


def add(parser: argparse.ArgumentParser) -> None:
    add_samples(parser)
    parser.add_argument(
        "--failure", metavar="EXPRESSION", help="over metrics and draws; default: that a trial is no success"
    )
    parser.add_argument("--samples", type=int, metavar="N", help="flights of a level; default: 4500")
    parser.add_argument(
        "--least", type=float, metavar="P", help="give up a failure less likely than this; default: 1e-9"
    )
    add_folder(parser, "rare.json, flights.parquet, and failures.parquet for perilune batch --draws")
    add_report(parser)
    add_requirements(parser, "probability, interval[1], interval[2] and flights")
    add_json(parser)
