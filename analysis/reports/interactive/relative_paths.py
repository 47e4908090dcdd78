"""The paths of SVG in half the letters: relative coordinates, in whole hundredths, so that no rounding adds up."""

from __future__ import annotations

import re

PATH = re.compile(r'(<path (?:[^>]* )?d=")([MLQCZ \d.\n-]+)(?=")')
TOKEN = re.compile(r"([MLQCZ])|(-?)(\d+)(?:\.(\d\d?)\d*)?")
POINTS = {"M": 1, "L": 1, "Q": 2, "C": 3, "Z": 0}  # of a command


def with_relative_paths(svg: str) -> str:
    """An <svg> element whose paths of absolute coordinates are relative; others and all else unchanged."""
    return PATH.sub(lambda match: match[1] + relative_path(match[2]), svg)


def relative_path(path: str) -> str:
    """A path of the absolute commands M, L, Q, C and Z as relative ones; decimals beyond two are cut off."""
    written = ""
    command, previous = "", ""
    numbers: list[int] = []
    at = start = (0, 0)
    for letter, sign, whole, decimals in TOKEN.findall(path):
        if letter:
            command = letter
        else:
            size = 100 * int(whole) + int(decimals.ljust(2, "0"))
            numbers.append(-size if sign else size)
        if len(numbers) < 2 * POINTS[command]:
            continue
        # A command that repeats the one before goes without its letter, but M M would mean M L.
        if command == "Z" or command != previous or command == "M":
            written += command.lower()
        written += _joined([number - at[axis % 2] for axis, number in enumerate(numbers)], after=written[-1:])
        at = (numbers[-2], numbers[-1]) if numbers else start
        start = at if command == "M" else start
        previous, numbers = command, []
    return written


def _joined(hundredths: list[int], after: str) -> str:
    """Numbers one after the other; a minus is its own separator, and so is a letter before them."""
    written = ""
    for number in hundredths:
        text = f"{abs(number) // 100 or ''}{f'.{abs(number) % 100:02d}'.rstrip('0').rstrip('.')}" or "0"
        separator = "-" if number < 0 else "" if not (written or after.isdigit()) else " "
        written += separator + text
    return written
