"""Commands in the documentation: sh and console blocks of pages, and examples of the verbs."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Sequence
from pathlib import Path

from docs.files import insert_files
from perilune.analysis.verbs.options.verbs import VERBS
from perilune.common.paths import ROOT

BLOCK = re.compile(r"^```(sh|console)\n(.*?)^```", re.MULTILINE | re.DOTALL)
DOTS = "..."
WALL_CLOCK = re.compile(r"^(\w+: (?:pass|fail),) [\d.]+ s$")
SAVED = re.compile(r"^Save it as `([\w/]+\.(?:py|toml))`:\n+```(?:python|toml)\n(.*?)^```", re.MULTILINE | re.DOTALL)
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


def commands_in(text: str) -> list[str]:
    """Return the commands of a page, in order, each on one line and without its comment."""
    collected = []
    for language, block in BLOCK.findall(text):
        for line in block.replace("\\\n", " ").splitlines():
            if language == "console" and not line.startswith("$ "):
                continue  # what it prints
            words = shlex.split(line.removeprefix("$ "), comments=True)
            if words:
                collected.append(line.removeprefix("$ ").split("  #")[0].strip())
    return collected


def documented() -> dict[str, list[str]]:
    """Return all commands by their page's path, or ``VERB --help``."""
    collected = {path.relative_to(ROOT).as_posix(): commands_in(path.read_text(encoding="utf-8")) for path in PAGES}
    collected |= {f"{name} --help": [*verb.examples] for name, verb in VERBS.items()}
    return {place: commands for place, commands in collected.items() if commands}


def printed_by(text: str) -> dict[str, list[str]]:
    """Return the lines that a page states for the commands of its blocks of console; none where it omits them."""
    printed: dict[str, list[str]] = {}
    for language, block in BLOCK.findall(text):
        command = ""
        for line in block.replace("\\\n", " ").splitlines() if language == "console" else ():
            if line.startswith("$ "):
                command = line.removeprefix("$ ").split("  #")[0].strip()
                printed[command] = []
            else:
                printed[command].append(line.rstrip())
    return printed


def first_difference(expected: Sequence[str], output: str, errors: str) -> str | None:
    """Return the first line of a page that a command does not print; None where it prints all.

    A line of dots stands for any lines; lines of standard error may be left out; wall-clock time is any, and paths
    begin in the working folder.
    """
    reported = [line for line in expected if line.startswith("perilune: ")]
    missing = next((line for line in reported if line not in errors.splitlines()), None)
    relative = output.replace(f"{Path.cwd()}/", "")
    actual = [WALL_CLOCK.sub("\\1 TIME", line.rstrip()) for line in relative.splitlines()]
    position, skips = 0, False
    for line in [line for line in expected if line not in reported] if missing is None else ():
        text = WALL_CLOCK.sub("\\1 TIME", line)
        if line == DOTS:
            skips = True
            continue
        ahead = actual[position:] if skips else actual[position : position + 1]
        if text not in ahead:
            return line
        position, skips = position + ahead.index(text) + 1, False
    left = [line for line in actual[position:] if line] if not skips and missing is None else []
    return missing or next(iter(left), None)


def saved_files(text: str) -> Iterator[tuple[str, str]]:
    """Name and content of the files that a page has its reader save."""
    yield from SAVED.findall(text)


def page_text(place: str) -> str:
    """Return the text of a page with the files that it shows; nothing for the examples of a verb."""
    path = Path(ROOT / place)
    return insert_files(path.read_text(encoding="utf-8")) if path.is_file() else ""
