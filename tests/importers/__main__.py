"""Every exported FMU in every importer of the package index: `make importers`, which writes the table of the page.

Blocks as FMUs of FMI 2.0 (native and Python) and 3.0, and each system as one FMU; each flies 32 steps with its start
values, and scalar outputs are compared with FMPy's.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import repeat
from pathlib import Path

import perilune
from perilune.analysis.runtime.ssp.archive import system_names
from perilune.common.paths import ROOT, shipped_fmu
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import local_platform
from tests.support.native.building import NATIVE, fmi3_fmu

from .masters import MASTERS
from .trial import Outcome, try_importers

PAGE = ROOT / "docs" / "guides" / "importers.md"
BEGIN, END = "<!-- importers -->\n\n", "\n<!-- end -->\n"


def fmus_by_kind(folder: Path) -> Iterator[tuple[str, list[Path]]]:
    """Yield the kinds of exported FMUs, each with its files; systems are compiled in ``folder``."""
    yield "FMI 2.0, native", [shipped_fmu(name, "native") for name in NATIVE]
    yield "FMI 2.0, Python", [shipped_fmu(name, "python") for name in catalogue()]
    yield "FMI 3.0, native", [fmi3_fmu(catalogue()[name]) for name in NATIVE]
    for name in system_names():
        perilune.export(name, as_fmu=True, platforms=[local_platform()], output=folder / f"{name}.fmu")
    yield "systems as one FMU", sorted(folder.iterdir())


def write_table(outcomes: dict[str, list[Outcome]]) -> tuple[str, list[str]]:
    """Return the table of kinds and importers, and the list of what was refused and why."""
    lines = [f"| FMUs | {' | '.join(MASTERS)} |", f"| --- |{' --- |' * len(MASTERS)}"]
    refused: dict[str, Counter[str]] = defaultdict(Counter)
    for kind, trials in outcomes.items():
        counts = []
        for master in MASTERS:
            flown = [trial for trial in trials if trial.master == master]
            counts.append(f"{sum(not trial.problem for trial in flown)} of {len(flown)}")
            refused[master].update(f"{kind}: {trial.fmu}: {trial.problem}" for trial in flown if trial.problem)
        lines.append(f"| {kind} | {' | '.join(counts)} |")
    return "\n".join(lines) + "\n", [f"{master}: {text}" for master, problems in refused.items() for text in problems]


def main() -> None:
    outcomes: dict[str, list[Outcome]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for kind, fmus in fmus_by_kind(Path(folder)):
            with ThreadPoolExecutor(os.cpu_count()) as pool:
                trials = pool.map(try_importers, fmus, repeat(tuple(MASTERS)))
                outcomes[kind] = [outcome for several in trials for outcome in several]
            print(kind, Counter(not outcome.problem for outcome in outcomes[kind]), file=sys.stderr, flush=True)
    table, refused = write_table(outcomes)
    text = PAGE.read_text(encoding="utf-8")
    begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
    PAGE.write_text(text[:begin] + table + text[end:], encoding="utf-8")
    print(table, *refused, sep="\n")


if __name__ == "__main__":
    main()
