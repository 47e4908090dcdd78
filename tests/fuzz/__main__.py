"""Fuzz everything, or one target: `python -m tests.fuzz [NAME] [--runs N] [--unguided]`.

`make fuzz` has what it needs installed; targets of Python with random inputs (`--unguided`) need nothing.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time

from perilune.common.paths import ROOT
from perilune.fmus_src.catalogue import catalogue
from tests.fuzz import fmi, guided, unguided

FOLDER = ROOT / "build" / "fuzz"
RUNS = {
    "manifests": 1_000_000,
    "shards": 100_000,
    **dict.fromkeys(("systems", "parameter_sets", "campaigns"), 500_000),
    **dict.fromkeys(("systems_with_arrays", "parameter_sets_with_arrays"), 500_000),
    **dict.fromkeys(("descriptions", "fmi3_descriptions"), 500_000),
    **dict.fromkeys(("mappings", "inputs", "draws", "expressions", "archives"), 500_000),
    "flights": 50_000,
    **dict.fromkeys(("fmi2", "fmi3"), 2_000_000),
}
VERSIONS = {"fmi2": 2, "fmi3": 3}  # of FMI, by the names of targets in C


def main() -> int:
    """Return the exit status: 1 where a target failed."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("name", nargs="?", choices=RUNS)
    parser.add_argument("--runs", type=int, metavar="N", help="inputs of each target")
    parser.add_argument("--unguided", action="store_true", help="one target of Python with random inputs")
    parser.add_argument("--first", type=int, default=0, metavar="N", help="number of the first random input")
    arguments = parser.parse_args()
    if arguments.unguided and arguments.name in (None, *VERSIONS):
        parser.error("--unguided: needs the name of a target of Python")
    if arguments.name is None:
        return max(_run(name, arguments.runs or runs) for name, runs in RUNS.items())
    runs = arguments.runs or RUNS[arguments.name]
    if arguments.name in VERSIONS:
        return _fuzz_fmus(arguments.name, runs)
    if arguments.unguided:
        unguided.fuzz(arguments.name, FOLDER / arguments.name, runs, arguments.first)
    else:
        guided.fuzz(arguments.name, FOLDER / arguments.name, runs)
    return 0


def _run(name: str, runs: int) -> int:
    """Run one target in another process, which its end may take along."""
    begin = time.monotonic()
    command = [sys.executable, "-m", "tests.fuzz", name, "--runs", str(runs)]
    log = FOLDER / f"{name}.log"
    FOLDER.mkdir(parents=True, exist_ok=True)
    with log.open("w") as output:
        status = subprocess.run(command, stdout=output, stderr=subprocess.STDOUT, cwd=ROOT, check=False).returncode
    print(
        f"{name}: {runs} inputs, {time.monotonic() - begin:.0f} s, {f'FAILED, see {log}' if status else 'good'}",
        flush=True,
    )
    return int(status != 0)


def _fuzz_fmus(name: str, runs: int) -> int:
    blocks = [block for block in catalogue().values() if not block.python_only]
    each = -(-runs // len(blocks))
    return int(not all([fmi.fuzz(block, VERSIONS[name], FOLDER / name / block.fmu_name, each) for block in blocks]))


if __name__ == "__main__":
    sys.exit(main())
