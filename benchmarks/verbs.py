"""Processor time of each verb, from the start to the end of the Python process.

    python -m benchmarks.verbs [SYSTEM] [--rounds N]

Prints user and system time (s), including children: the median over rounds in which the commands take turns, after a
round that fills caches and bytecode. Compare only numbers of one run, since other programs may load the machine.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys

COMMANDS = ("list", "describe SYSTEM", "validate SYSTEM", "run SYSTEM")


def processor_time(arguments: list[str]) -> float:
    """Return the processor time (s) of `perilune` with these arguments. Raises CalledProcessError."""
    environment = {name: text for name, text in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    before = os.times()
    command = [sys.executable, "-m", "perilune", *arguments]
    subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, check=True)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def main() -> None:
    """Measure the verbs and print the times."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("system", nargs="?", default="lunar_landing")
    parser.add_argument("--rounds", type=int, default=5)
    parsed = parser.parse_args()
    commands = [command.replace("SYSTEM", parsed.system) for command in COMMANDS]
    rounds = [[processor_time(command.split()) for command in commands] for _ in range(parsed.rounds + 1)][1:]
    for command, times in zip(commands, zip(*rounds, strict=True), strict=True):
        print(f"perilune {command:30}  {statistics.median(times):5.2f} s")


if __name__ == "__main__":
    main()
