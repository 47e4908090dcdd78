"""The commands that the documentation gives: blocks of sh and console in pages, and the examples of the verbs."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from pathlib import Path

from perilune.analysis.verbs.options.verbs import VERBS
from perilune.fmus_src.paths import ROOT

BLOCK = re.compile(r"^```(sh|console)\n(.*?)^```", re.MULTILINE | re.DOTALL)
SAVED = re.compile(r"^Save it as `(\w+\.py)`:\n+```python\n(.*?)^```", re.MULTILINE | re.DOTALL)
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


def commands_in(text: str) -> list[str]:
    """The commands of a page, in order, each on one line and without its comment."""
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
    """All commands by where they stand: a page's path, or ``VERB --help``."""
    collected = {path.relative_to(ROOT).as_posix(): commands_in(path.read_text(encoding="utf-8")) for path in PAGES}
    collected |= {f"{name} --help": [*verb.examples] for name, verb in VERBS.items()}
    return {place: commands for place, commands in collected.items() if commands}


def saved_files(text: str) -> Iterator[tuple[str, str]]:
    """Name and content of the files that a page has its reader save."""
    yield from SAVED.findall(text)


def page_text(place: str) -> str:
    """The page itself; nothing for the examples of a verb."""
    path = Path(ROOT / place)
    return path.read_text(encoding="utf-8") if path.is_file() else ""
