"""Requirements, for commands that are not verbs yet."""

import argparse
import sys

from ...verbs.common.requirements import read_requirements, requirement_problems


def add_requirements(parser: argparse.ArgumentParser, numbers: str) -> None:
    parser.add_argument(
        "--require", action="append", default=[], metavar="EXPRESSION", help=f"exit 1 unless true of {numbers}"
    )


def check_requirements(requirements, values):  # type: ignore[no-untyped-def]
    lines = requirement_problems(requirements, values)
    for line in lines:
        print(f"perilune: {line}".replace("`require`", "--require"), file=sys.stderr)
    return not lines


__all__ = ["add_requirements", "check_requirements", "read_requirements"]
