"""The options of perilune plan landing-bound."""

from __future__ import annotations

import argparse
from pathlib import Path

from ....design.trajectories.bounds import LANDING
from ....design.trajectories.vehicle import LANDING_VEHICLE
from ...common.options import add_json, add_system
from ...common.vehicle import add_vehicle, number, whole

PLACES = {
    "range": "m along the ground from the site to the start",
    "altitude": "m, of the start",
    "speed": "m/s at the start",
    "climb": "deg, of the velocity at the start above the horizontal",
    "target_altitude": "m above the site, at rest",
    "radius": "m, of the Moon",
    "gravitational_parameter": "m3/s2, of the Moon",
}
SIGNED = ("climb", "target_altitude")
HELP = "bound the propellant of braking and landing in one: a point mass, attitude free"


def add(parser: argparse.ArgumentParser) -> None:
    add_system(parser, needed=False)
    add_vehicle(parser, LANDING_VEHICLE)
    group = parser.add_argument_group("landing")
    for name, words in PLACES.items():
        reader = number(-89.0, 89.0) if name == "climb" else number(0.0, above=name not in SIGNED)
        group.add_argument(f"--{name.replace('_', '-')}", type=reader, metavar="X",
                           help=f"{words}; default: {getattr(LANDING, name):g}")  # fmt: skip
    parser.add_argument("--direct", action="store_true", help="check it by a direct method")
    parser.add_argument("--intervals", type=whole, metavar="N", help="of both; default: 240")
    parser.add_argument("--store", action="store_true", help="keep it in the system's folder, for the pages of flights")
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures")
    add_json(parser)
