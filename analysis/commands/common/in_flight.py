"""Options of what happens in flight: inputs over time, the wall clock, what FMUs say."""

from __future__ import annotations

import argparse
import math

from argcomplete.completers import FilesCompleter

from ...runtime.system.in_flight.series import InputSeries, read_series
from ...runtime.system.in_flight.watch import LOG_LEVELS, Watch
from .completers import completed


def add_input(parser: argparse.ArgumentParser) -> None:
    """Inputs over time; read with `series`."""
    given = parser.add_argument(
        "--input", metavar="F.csv", help="inputs over time: first column time (s), then inputs by name"
    )
    completed(given, FilesCompleter(("csv",)))


def add_watch(parser: argparse.ArgumentParser) -> None:
    """How a flight is watched; read with `watch`."""
    parser.add_argument(
        "--log",
        choices=LOG_LEVELS,
        help="what FMUs say, to standard error: error (discard, error, fatal), warning too, info (all that they say by "
        "themselves), all (they are asked for all their categories)",
    )
    parser.add_argument(
        "--timeout",
        type=_positive,
        metavar="SECONDS",
        help="end a flight that takes longer, by the wall clock, at its next communication point: exit status 1",
    )


def series(options: argparse.Namespace) -> InputSeries | None:
    """The inputs over time of a parsed command line. Raises InputError."""
    return None if options.input is None else read_series(options.input)


def watch(options: argparse.Namespace) -> Watch:
    """How the flights of a parsed command line are watched."""
    return Watch(options.timeout, options.log)


def _positive(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text!r} is not a positive number of seconds")
    return value
