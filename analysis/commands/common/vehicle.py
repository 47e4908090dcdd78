"""The vehicle of a plan on the command line, and what its options have in common."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Iterable

from ...design.trajectories.vehicle import Vehicle

UNITS = {
    "mass": "kg",
    "dry_mass": "kg",
    "specific_impulse": "s",
    "maximum_thrust": "N",
    "minimum_thrust": "N",
}
LARGEST = 100_000  # intervals


def number(least: float, most: float = math.inf, above: bool = True) -> Callable[[str], float]:
    """A reader of finite numbers above ``least`` (or from it on) up to ``most``."""

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not (math.isfinite(value) and (value > least if above else value >= least) and value <= most):
            end = "" if most == math.inf else f" and at most {most:g}"
            raise argparse.ArgumentTypeError(f"{text!r} is not a number {'above' if above else 'from'} {least:g}{end}")
        return value

    return read


def whole(text: str) -> int:
    """A number of intervals."""
    if not (text.isascii() and text.isdigit() and 10 <= int(text) <= LARGEST):
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 10 to {LARGEST}")
    return int(text)


def add_vehicle(parser: argparse.ArgumentParser, default: Vehicle, names: Iterable[str] = UNITS) -> None:
    """Options for a vehicle; one that is not given is None, so that something else can stand below it."""
    group = parser.add_argument_group("vehicle")
    for name in names:
        value = getattr(default, name)
        group.add_argument(
            f"--{name.replace('_', '-')}",
            type=number(0.0, above=name not in ("dry_mass", "minimum_thrust")),
            metavar="X",
            help=f"{UNITS[name]}; default: {value:g}",
        )


def given(options: argparse.Namespace, names: Iterable[str] = UNITS) -> dict[str, float]:
    """The options among these that the command line has."""
    return {name: getattr(options, name) for name in names if getattr(options, name, None) is not None}


def enough(vehicle: Vehicle, propellant: float, what: str) -> bool:
    """Whether the propellant (kg) that a plan takes is on board; a line where it is not."""
    carried = vehicle.mass - vehicle.dry_mass
    if propellant <= carried:
        return True
    print(f"perilune: {what} takes {propellant:.2f} kg of propellant; {carried:g} kg are on board", file=sys.stderr)
    return False


def burns_text(burns: Iterable[tuple[float, float]]) -> str:
    """``full thrust 0.0 to 65.6 s, 112.3 to 292.7 s``."""
    return "full thrust " + ", ".join(f"{begin:.1f} to {end:.1f} s" for begin, end in burns)
