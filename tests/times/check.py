"""The tests for a change of one room, in two minutes: `make check ROOM=analysis/campaigns/draws`.

First those of the room and of rooms inside it, then those of rooms that import it directly, the dearest last; then one
simulation and one campaign. Files that do not fit are listed: `make test` runs them. Times are those of
build/test_times.json, which every run of pytest brings up to date.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterable, Mapping
from pathlib import Path

from tests.folders import importing_files
from tests.times.recording import read_times

ROOT = Path(__file__).parents[2]
BUDGET = 110.0  # s, of wall time, less what simulation and campaign take
WORKERS = 2
UNKNOWN = 3.0  # s, of a file without times
SYSTEM = "lunar_terminal_guidance"
ALWAYS = ["tests/test_architecture.py", "tests/test_house.py"]


def tests_of(rooms: Iterable[str], *, inside: bool) -> list[str]:
    """Return the test files of rooms, with those of folders inside of theirs or without."""
    files = []
    for room in rooms:
        below = room.split("/", 1)[-1] if "/" in room else room
        folders = [ROOT / "tests" / below, ROOT / "tests" / "blocks" / below]  # those of blocks lie in tests/blocks
        folder = next((each for each in folders if each.is_dir()), folders[0])
        files += [path for path in (folder.rglob if inside else folder.glob)("test_*.py")]
    return sorted({path.relative_to(ROOT).as_posix() for path in files})


def importers_of(room: str) -> list[str]:
    """Return the folders with a file that imports from a folder, or from one inside of it."""
    start = room.replace("/", ".")
    return sorted(
        folder
        for folder, pairs in importing_files().items()
        if folder != room and not folder.startswith(f"{room}/")
        if any(module == start or module.startswith(f"{start}.") for _, module in pairs)
    )


def select(groups: Iterable[Iterable[str]], times: Mapping[str, float], budget: float) -> tuple[list[str], list[str]]:
    """Return the files that fit into a ``budget`` (s), group after group and the dearest last; and those left out."""
    chosen: list[str] = []
    left: list[str] = []
    for group in groups:
        for file in sorted(set(group) - set(chosen) - set(left), key=lambda each: times.get(each, UNKNOWN)):
            cost = times.get(file, UNKNOWN)
            (chosen if cost <= budget else left).append(file)
            budget -= cost if cost <= budget else 0.0
    return chosen, left


def wall_times() -> dict[str, float]:
    """Return the wall time (s) of each test file."""
    times: dict[str, float] = defaultdict(float)
    for name, entry in read_times().items():
        times[name.split("::")[0]] += entry["wall"]
    return times


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.times.check", description=__doc__)
    parser.add_argument("room", help="a folder of analysis, common or fmus_src")
    room = parser.parse_args().room.strip("/")
    if not (ROOT / room).is_dir() or room.split("/")[0] not in ("analysis", "common", "fmus_src"):
        print(f"make check: {room}: no folder of analysis, common or fmus_src", file=sys.stderr)
        return 2
    local = tests_of([room], inside=True)
    if any(file.startswith("tests/blocks/") for file in local):
        local.append("tests/blocks/test_checks.py")
    importing = tests_of(importers_of(room), inside=False)
    if not local and not importing:
        print(f"make check: {room}: no tests of it or of its importers; run make test", file=sys.stderr)
        return 2
    chosen, left = select([ALWAYS, local, importing], wall_times(), WORKERS * BUDGET)
    print(f"{room}: {len(chosen)} test files of {len(chosen) + len(left)}", flush=True)
    status = subprocess.run([sys.executable, "-m", "pytest", "-n", str(WORKERS), *chosen], cwd=ROOT).returncode
    with tempfile.TemporaryDirectory() as folder:
        for words in (["run", SYSTEM], ["batch", SYSTEM, "--campaign", "paper", "--trials", "20", "--output", folder]):
            if words[0] == "batch":
                words.append("--overwrite")
            done = subprocess.run([sys.executable, "-m", "perilune", *words], cwd=ROOT, capture_output=True, text=True)
            status = max(status, done.returncode)
            print(f"perilune {words[0]} {SYSTEM}: exit status {done.returncode}", flush=True)
            if done.returncode:
                print(done.stdout + done.stderr)
    for file in left:
        print(f"left to make test: {file}")
    return status


if __name__ == "__main__":
    sys.exit(main())
