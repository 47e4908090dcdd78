"""Campaigns whose TOML, numbers, expressions or references are hostile."""

from __future__ import annotations

import os
from pathlib import Path

from tests.support.builders import document, pack
from tests.support.refused import PLAIN

from .case import Case, Content, Write, put

FILE = "hostile.toml"
HIGH = "draw.ramp.slope.high"
BATCH = f"batch good.ssp --campaign {FILE} --output out"
GOOD = """
system = "good"
trials = 4
seed = 1
[draw."ramp.slope"]
distribution = "uniform"
low = 0
high = 1
[metric.end]
expression = "ramp.y"
reduction = "final"
unit = "m"
[success]
expression = "end > 0"
"""


def swapped(old: str, new: str) -> str:
    assert old in GOOD
    return GOOD.replace(old, new, 1)


def campaign_file(content: Content, **more: bytes) -> Write:
    """Return a writer of a campaign and the good system that it is for."""

    def write(folder: Path, fmus: Path) -> None:
        pack(folder / "good.ssp", fmus, document(PLAIN))
        put(FILE, content)(folder, fmus)
        for name, text in more.items():
            (folder / f"{name}.toml").write_bytes(text)

    return write


def piped(folder: Path, fmus: Path) -> None:
    campaign_file('extends = "pipe.toml"')(folder, fmus)
    os.mkfifo(folder / "pipe.toml")


LARGE = ("at most 256000",)
DOTTED = ".".join("a" * 10_000)
SPAN = "low = -1.7e308\nhigh = 1.7e308"
TEXTS: dict[str, tuple[Content, tuple[str, ...]]] = {
    "empty": ("", ("system", "missing")),
    "no TOML": ("\x1b[2J{{{", ("not TOML",)),
    "not UTF-8": (b"system = '\xff\xfe'", ("not UTF-8",)),
    "UTF-16": (GOOD.encode("utf-16"), ("not UTF-8",)),
    "NULs": ("\0" * 1000, ("not TOML",)),
    "an integer of 10^6 digits": (lambda: swapped("trials = 4", f"trials = {'9' * 1_000_000}"), LARGE),
    "an integer of 10^5 digits": (swapped("trials = 4", f"trials = {'9' * 100_000}"), ("not TOML",)),
    "an integer of 4000 digits": (swapped("trials = 4", f"trials = {'9' * 4000}"), ("trials", "64 bits")),
    "a hexadecimal of 10^5 digits": (swapped("seed = 1", f"seed = 0x{'f' * 100_000}"), ("seed", "64 bits")),
    "a seed of 65 bits": (swapped("seed = 1", f"seed = {2**64}"), ("seed", "64 bits")),
    "a date of the year 0": (swapped("seed = 1", "seed = 0000-01-01"), ("not TOML",)),
    "an array in arrays, 10^5 deep": (f"a = {'[' * 100_000}{']' * 100_000}", ("not TOML",)),
    "arrays of 10^5, open": (f"a = {'[' * 100_000}", ("not TOML",)),
    "tables in tables, 50 000 deep": (f"a = {'{a=' * 50_000}1{'}' * 50_000}", ("not TOML",)),
    "a name of 10^4 parts": (f"{DOTTED} = 1", ("100 parts",)),
    "a draw of 10^4 parts": (GOOD.replace('[draw."ramp.slope"]', f"[draw.{DOTTED}]"), ("100 parts",)),
    "a name of 10^4 parts in quotes": (f"{DOTTED.replace('a', chr(34) * 2)} = 1", ("100 parts",)),
    "10^5 tables": (lambda: "".join(f"[t{n}]\na = 1\n" for n in range(100_000)), LARGE),
    "15 000 tables": ("".join(f"[t{n}]\na = 1\n" for n in range(15_000)), ("t0", "unknown key")),
    "a text of 20 MB": (lambda: f'system = "{"a" * 20_000_000}"', LARGE),
    "an open text": (f'system = "{"a" * 200_000}', ("not TOML",)),
    "an escape in a name": (GOOD + '[metric."\\u001b[2J"]\nexpression = "1"\nreduction = "final"\n', (r"\x1b[2J",)),
    "an escape in a key": (GOOD.replace("[success]", '[success]\n"\\u202e\\u001b]0;x\\u0007" = 1'), (r"\u202e",)),
    "a key of backslashes": ('"' + "\\\\" * 100_000 + "\n", ("not TOML",)),
    "10^18 trials": (swapped("trials = 4", f"trials = {10**18}"), ("trials", "at most 1e+09")),
    "0 trials": (swapped("trials = 4", "trials = 0"), ("trials",)),
    "negative trials": (swapped("trials = 4", "trials = -4"), ("trials",)),
    "trials of nan": (swapped("trials = 4", "trials = nan"), ("trials",)),
    "trials as a text": (swapped("trials = 4", 'trials = "4"'), ("trials",)),
    "a negative seed": (swapped("seed = 1", "seed = -1"), ("seed",)),
    "an infinite draw": (swapped("high = 1", "high = inf"), (HIGH,)),
    "a draw of nan": (swapped("high = 1", "high = nan"), (HIGH,)),
    "a draw of 1e400": (swapped("high = 1", "high = 1e400"), (HIGH,)),
    "a draw of 9**9**9": (swapped("high = 1", 'high = "9**9**9**9"'), (HIGH,)),
    "a draw over +-1.7e308": (swapped("low = 0\nhigh = 1", SPAN), (HIGH, "too far")),
    "a grid over +-1.7e308": (swapped('"uniform"\nlow = 0\nhigh = 1', f'"grid"\ncount = 5\n{SPAN}'), (HIGH, "too far")),
    "a grid of 10^12 points": (
        swapped('"uniform"', '"grid"\ncount = 1000000000000'),
        ("draw.ramp.slope.count", "at most 10000"),
    ),
    "a grid of -5 points": (swapped('"uniform"', '"grid"\ncount = -5'), ("draw.ramp.slope.count",)),
    "every -1st row": (GOOD + "[record]\nevery = -1\nsignals = ['ramp.y']\n", ("record.every",)),
}
CASES = {
    f"campaign: {name}": Case(campaign_file(content), (BATCH,), (FILE, *words))
    for name, (content, words) in TEXTS.items()
}
CASES |= {
    f"campaign: {name}": Case(write, (BATCH,), (FILE, "extends"))
    for name, write in {
        "of itself": campaign_file(f'extends = "{FILE}"'),
        "of itself, by another path": campaign_file(f'extends = "./x/../{FILE}"'),
        "of a cycle": campaign_file('extends = "a.toml"', a=b'extends = "b.toml"', b=b'extends = "hostile.toml"'),
        "of a device": campaign_file('extends = "/dev/zero"'),
        "of a folder": campaign_file('extends = "/tmp"'),
        "of a URL": campaign_file('extends = "http://127.0.0.1:9/a.toml"'),
        "of a pipe": piped,
        "of a number": campaign_file("extends = 1"),
        "of a text with escapes": campaign_file('extends = "\\u001b[2J\\u202e"'),
        "of a name of 10^5": campaign_file(f'extends = "{"a" * 100_000}"'),
        "of a NUL": campaign_file('extends = "a\\u0000"'),
    }.items()
}
CHAIN = {f"a{n}": f'extends = "a{n + 1}.toml"'.encode() for n in range(200)}
DOUBLE = {f"a{n}": f'extends = ["a{n + 1}.toml", "./a{n + 1}.toml"]'.encode() for n in range(40)} | {"a40": b"a = 1"}
CASES |= {
    "campaign: of a chain of 200": Case(
        campaign_file('extends = "a0.toml"', **CHAIN), (BATCH,), ("a99.toml", "at most 100")
    ),
    "campaign: of 2^40 files": Case(
        campaign_file('extends = "a0.toml"', **DOUBLE), (BATCH,), ("extends", "at most 100")
    ),
    "campaign: 10^12 points of a sweep": Case(campaign_file(GOOD), (f"{BATCH} --set gain.k=0:1e6:1e-6",), ("gain.k",)),
    "campaign: 10^8 points of two sweeps": Case(
        campaign_file(GOOD),
        (f"{BATCH} --set ramp.start=0:1:1e-4 --set ramp.flag_at=0:9999:1",),
        ("ramp.start",),
    ),
    "campaign: trials of the option": Case(
        campaign_file(GOOD),
        (f"{BATCH} --trials 1000000000000000000",),
        ("hostile.toml: trials",),
    ),
}
