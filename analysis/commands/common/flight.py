"""Text of a flight, for commands that are not verbs yet."""

import sys

from ...verbs.common.flight_text import flight_lines, flight_problems


def check_flight(*arguments):  # type: ignore[no-untyped-def]
    lines = flight_problems(*arguments)
    for line in lines:
        print(f"perilune: {line}", file=sys.stderr)
    return not lines


__all__ = ["check_flight", "flight_lines"]
