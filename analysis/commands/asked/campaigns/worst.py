"""The options of perilune worst."""

from __future__ import annotations

import argparse

from ...common.options import add_json
from ...common.requirements import add_requirements
from ...common.samples import add_folder, add_report, add_samples


def add(parser: argparse.ArgumentParser) -> None:
    add_samples(parser)
    parser.add_argument(
        "--metric",
        metavar="EXPRESSION",
        help="over metrics and draws, the larger the worse; default: the margin by which a trial is no success",
    )
    loop = parser.add_argument_group("a margin in place of a metric")
    loop.add_argument(
        "--loop", metavar="NAME", help="the least margin of a loop that the SSD names, or of COMPONENT.CONNECTOR to cut"
    )
    loop.add_argument("--margin", metavar="KIND", help="disk (the default), modulus, gain, phase or delay")
    loop.add_argument("--point", metavar="NAME", help="the operating point of the loop; default: its only one")
    loop.add_argument("--at", type=float, metavar="T", help="time of the operating point of a cut, s; default: 0")
    parser.add_argument("--sigmas", type=float, metavar="K", help="how far normal draws go; default: 3")
    parser.add_argument("--flights", type=int, metavar="N", help="how many to fly; default: 2000, of a margin 500")
    parser.add_argument(
        "--realisations",
        type=int,
        metavar="K",
        help="of random noise, the same at every point; default: 5, of a margin 1; 10 K fresh ones at the end",
    )
    parser.add_argument(
        "--quantile",
        type=float,
        metavar="Q",
        help="of the realisations, from best to worst: 0.5 the median, 1 the worst; default: 0.5",
    )
    add_folder(parser, "worst.json, flights.parquet, and worst.parquet for perilune batch or stability --draws")
    add_report(parser)
    add_requirements(parser, "worst, random, fresh_worst, fresh_quantile and flights")
    add_json(parser)
