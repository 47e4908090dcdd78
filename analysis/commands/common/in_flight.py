"""Options of what happens in flight: inputs over time."""

from __future__ import annotations

import argparse

from argcomplete.completers import FilesCompleter

from ...system.series import InputSeries, read_series
from .completers import completed


def add_input(parser: argparse.ArgumentParser) -> None:
    """Inputs over time; read with `series`."""
    given = parser.add_argument(
        "--input", metavar="F.csv", help="inputs over time: first column time (s), then inputs by name"
    )
    completed(given, FilesCompleter(("csv",)))


def series(options: argparse.Namespace) -> InputSeries | None:
    """The inputs over time of a parsed command line. Raises InputError."""
    return None if options.input is None else read_series(options.input)
