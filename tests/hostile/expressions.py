"""Expressions of campaigns that are too deep, too long, or meant to reach what they should not."""

from __future__ import annotations

from .campaigns import FILE, GOOD, campaign_file
from .case import Case

LARGE = ("at most 10000",)
DEEP = 2000
EXPRESSIONS: dict[str, tuple[str, tuple[str, ...]]] = {
    "10^5 parentheses": ("(" * 100_000 + "ramp.y" + ")" * 100_000, LARGE),
    "parentheses": ("(" * DEEP + "ramp.y" + ")" * DEEP, ("parentheses",)),
    "signs": ("-" * 9000 + "ramp.y", ("Error",)),
    "terms": ("ramp.y" + "+1" * 4000, ("Error",)),
    "powers": ("ramp.y" + "**2" * 3000, ("Error",)),
    "nots": ("not " * DEEP + "ramp.y", ("Error",)),
    "calls": ("abs(" * 1900 + "ramp.y" + ")" * 1900, ("parentheses",)),
    "attributes": ("ramp" + ".y" * 95 + "[1]" * DEEP, ("Error",)),
    "digits": ("9" * 9000, ("digits",)),
    "a comparison of 50 000": ("ramp.y" + " < 1" * 50_000, LARGE),
    "30 000 arguments": ("max(" + "ramp.y," * 30_000 + "1)", LARGE),
    "a class": ("ramp.__class__.__mro__[1].__subclasses__()", ("not a function",)),
    "an import": ("__import__('os').system('touch evil')", ("not a function",)),
    "a lambda": ("(lambda: 1)()", ("not a function",)),
    "a comprehension": ("[x for x in (1,)]", ("not allowed",)),
    "an assignment": ("(x := 1)", ("not allowed",)),
    "a string": ("'a' * 999999999", ("not allowed",)),
    "a complex number": ("1j", ("not allowed",)),
    "a star": ("max(*ramp.y)", ("has a keyword or starred argument",)),
    "await": ("await ramp.y", ("not allowed",)),
    "a NUL": (r"\u0000", ("null character",)),
    "an escape": (r"\u001b[2J", (r"\x1b[2J",)),
    "a direction of writing": (r"ramp.y\u202e", (r"\u202e",)),
}
WANTED = 'expression = "ramp.y"'
CASES = {
    f"expression: {name}": Case(
        campaign_file(GOOD.replace(WANTED, f'expression = "{text}"')),
        (f"prepare good.ssp --campaign {FILE} --output out",),
        (FILE, "metric.end.expression", *words),
    )
    for name, (text, words) in EXPRESSIONS.items()
}
