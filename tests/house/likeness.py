"""Places that say the same: runs of six lines or more that two places of the product have in common."""

from __future__ import annotations

import re
from collections import defaultdict
from itertools import combinations

from .size import Measure
from .sources import PRODUCT, Checkout, Source

SIX = 6
TOP = 45
TOKEN = re.compile(r"""[rbfu]*("(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')|(?<!\w)\d[\w.]*|\s*\#.*""")
OPTION = re.compile(r"\w+: [^=]+( = .+)?,$|\w+=.+,$|.*add_argument\(.*")


def like_lines(checkout: Checkout) -> Measure:
    """Count pairs of places of the product with six or more successive lines alike, and how many of the longest 45 are
    option lists.

    Compared are lines without indentation and comments, with every string as "" and every number as 0, names as they
    stand; blank lines, docstrings and imports are passed over, and six lines must hold three different ones. Successive
    windows of six that two places have in common are one pair. It is an option list if half of its lines or more are
    parameters (`name: type = default,`), keywords (`name=value,`) or calls of `add_argument`.
    """
    files = [(source, like(source)) for source in checkout.below(*PRODUCT)]
    windows: defaultdict[tuple[str, ...], list[tuple[int, int]]] = defaultdict(list)
    for index, (_, lines) in enumerate(files):
        for start in range(len(lines) - SIX + 1):
            windows[tuple(text for _, text in lines[start : start + SIX])].append((index, start))
    shared: defaultdict[tuple[int, int, int], set[int]] = defaultdict(
        set
    )  # (file, file, distance) -> starts in the first
    for window, places in windows.items():
        if len({*window}) >= 3:
            for (a, i), (b, j) in combinations(places, 2):
                if a != b or j - i >= SIX:
                    shared[a, b, j - i].add(i)
    pairs = []
    for (a, b, distance), starts in shared.items():
        for start in sorted(starts):
            if start - 1 not in starts:
                length = next(n for n in range(len(starts) + 1) if start + n not in starts) + SIX - 1
                run = [text for _, text in files[a][1][start : start + length]]
                first, second = files[a][1][start][0], files[b][1][start + distance][0]
                is_options = 2 * sum(bool(OPTION.match(text)) for text in run) >= length
                pairs.append((-length, f"{files[a][0].path}:{first}", f"{files[b][0].path}:{second}", is_options))
    pairs.sort()
    entries = [f"{-n} lines: {a} = {b}{' (options)' if o else ''}" for n, a, b, o in pairs]
    return f"{len(pairs)}, of which {sum(o for *_, o in pairs[:TOP])} of the top {TOP} are option lists", entries


def like(source: Source) -> list[tuple[int, str]]:
    """Return the compared lines, each with its number."""
    passed = {n for node in [*source.docstrings, *source.imports] for n in range(node.lineno, node.end_lineno + 1)}
    normal = ((number, TOKEN.sub(_normal, line).strip()) for number, line in enumerate(source.text.splitlines(), 1))
    return [(number, text) for number, text in normal if text and number not in passed]


def _normal(match: re.Match[str]) -> str:
    return '""' if match[1] else "" if match[0].lstrip().startswith("#") else "0"
