"""`--require EXPRESSION`: what has to be true of a result's numbers, or the command ends with status 1."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from ...campaigns.spec.expressions import Expression
from ...common.errors import InputError, suggestion


def add_requirements(parser: argparse.ArgumentParser, numbers: str) -> None:
    parser.add_argument(
        "--require", action="append", default=[], metavar="EXPRESSION", help=f"exit 1 unless true of {numbers}"
    )


def read_requirements(texts: Sequence[str], known: Collection[str], families: tuple[str, ...] = ()) -> list[Expression]:
    """Requirements on known numbers, or on those whose names begin like ``families``. Raises InputError."""
    found = [Expression(text, ("--require", text)) for text in texts]
    for requirement in found:
        for name in sorted(requirement.names - set(known)):
            if not name.startswith(families or ("\0",)):
                raise InputError("--require", name, "no such number in what results", suggestion(name, known))
    return found


def check_requirements(requirements: Sequence[Expression], values: Mapping[str, float]) -> bool:
    """Whether all hold; those that do not, and those on a number that could not be had, are told."""
    failed = [
        requirement.text
        for requirement in requirements
        if not all(np.isfinite(values.get(name, np.nan)) for name in requirement.names)
        or not requirement.evaluate(values)
    ]
    for text in failed:
        print(f"perilune: --require: {text}: not met", file=sys.stderr)
    return not failed
