"""The options of perilune plan hover-transfer."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from ....design.trajectories.vehicle import HOVER_MARGINS as MARGINS
from ....design.trajectories.vehicle import HOVER_TRANSFER as TRANSFER
from ....design.trajectories.vehicle import HOVER_VEHICLE as VEHICLE
from ...common.options import add_json
from ...common.vehicle import add_vehicle, number, whole

HELP = "plan a transfer between two hovers: simplified programme, true optimum, point-mass bound"


def add(parser: argparse.ArgumentParser) -> None:
    way = parser.add_argument_group("transfer")
    way.add_argument("--distance", type=number(0.0, above=False), default=TRANSFER.distance, metavar="X",
                     help=f"m, along; default: {TRANSFER.distance:g}")  # fmt: skip
    way.add_argument("--descent", type=number(0.0), default=TRANSFER.descent, metavar="X",
                     help=f"m, down; default: {TRANSFER.descent:g}")  # fmt: skip
    way.add_argument("--gravity", type=number(0.0), default=TRANSFER.gravity, metavar="X",
                     help=f"m/s2, uniform; default: {TRANSFER.gravity:g}")  # fmt: skip
    way.add_argument("--t7", type=number(0.0), metavar="T", help="s, the end; default: the one of least propellant")
    add_vehicle(parser, VEHICLE)
    limits = parser.add_argument_group("control margins")
    limits.add_argument(
        "--margins",
        action="store_true",
        help=f"leave feedback its part: throttle {MARGINS.minimum_throttle:g} to {MARGINS.maximum_throttle:g}, "
        f"{math.degrees(MARGINS.angular_acceleration):g} deg/s2; without: all that the vehicle has",
    )
    limits.add_argument("--maximum-throttle", type=number(0.0, 1.0), metavar="X", help="of the largest thrust")
    limits.add_argument("--minimum-throttle", type=number(0.0, 1.0, above=False), metavar="X", help="of the same")
    limits.add_argument("--angular-acceleration", type=number(0.0), metavar="X", help="deg/s2; the vehicle's is 1")
    more = parser.add_argument_group("more than the programme")
    more.add_argument("--optimum", action="store_true", help="the true optimum, too, by direct multiple shooting")
    more.add_argument("--bound", action="store_true", help="the bound of a point mass, too, by the convex form")
    more.add_argument("--curves", action="store_true", help="propellant over t7 and over distance, too")
    more.add_argument("--intervals", type=whole, metavar="N", help="of both; default: 320 and 240")
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures, curves included")
    add_json(parser)
