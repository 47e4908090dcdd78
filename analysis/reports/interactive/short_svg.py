"""Figures in a page in fewer letters: paths are relative, names and blanks that nothing refers to are left out."""

from __future__ import annotations

import re

PATH = re.compile(r'(<path (?:[^>]* )?d=")([MLQCZz \d.\n-]+)(?=")')
NAME = re.compile(r'(<(?:g|path|use)) id="([^"]*_\d+)"')  # of matplotlib's own making
REFERENCE = re.compile(r'(?:href="|url\()#([^")]*)')
BLANKS = re.compile(r">\s+<")
UNTURNED = re.compile(r' transform="rotate\(-?0 [^)"]*\)"')
STYLE = re.compile(r'(?<= style=")[^"]*')
TOKEN = re.compile(r"([MLQCZz])|(-?)(\d+)(?:\.(\d\d?)\d*)?")
POINTS = {"M": 1, "L": 1, "Q": 2, "C": 3, "Z": 0}  # of a command


def shorten(svg: str) -> str:
    """An <svg> element that looks the same, without names that it does not refer to itself."""
    referred = set(REFERENCE.findall(svg))
    named = NAME.sub(lambda match: match[0] if match[2] in referred else match[1], svg)
    styled = STYLE.sub(
        lambda match: match[0].replace("; ", ";").replace(": ", ":"), BLANKS.sub("><", UNTURNED.sub("", named))
    )
    return PATH.sub(lambda match: match[1] + relative_path(match[2]), styled)


def relative_path(path: str) -> str:
    """A path of the absolute commands M, L, Q, C and Z as relative ones, decimals beyond two cut off.

    Coordinates are whole hundredths, so no rounding adds up.
    """
    written = ""
    command, previous = "", ""
    numbers: list[int] = []
    at = start = (0, 0)
    for letter, sign, whole, decimals in TOKEN.findall(path):
        if letter:
            command = letter.upper()
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
