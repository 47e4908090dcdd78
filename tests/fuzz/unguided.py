"""Targets of Python with random inputs: nothing is traced, so that many more are read in the time."""

from __future__ import annotations

import random
import shutil
import time
from collections.abc import Iterator
from pathlib import Path

import psutil

from tests.fuzz.targets import TARGETS

LONGEST = 4096  # bytes
TIMEOUT = 20.0  # s for one input
MOST_MEMORY = 2500  # MB
EVERY = 10_000  # inputs from one line of the log to the next


def fuzz(name: str, folder: Path, runs: int, first: int = 0) -> None:
    """Run ``runs`` inputs of a target of `targets`, from number ``first`` on.

    Raises what the target raises, TimeoutError, and MemoryError.
    """
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    one_input = TARGETS[name](folder).hypothesis.fuzz_one_input  # type: ignore[attr-defined]
    read = 0
    for count, content in enumerate(_contents(range(first, first + runs)), 1):
        begin = time.monotonic()
        try:
            read += one_input(content) is not None
        except BaseException:
            (folder / "failed").write_bytes(content)
            raise
        if time.monotonic() - begin > TIMEOUT:
            (folder / "hung").write_bytes(content)
            raise TimeoutError(folder / "hung")
        if count % EVERY == 0 or count == runs:
            _report(count, read)


def _contents(seeds: range) -> Iterator[bytes]:
    for seed in seeds:
        yield random.Random(seed).randbytes(LONGEST)


def _report(count: int, read: int) -> None:
    """Print a line of the log: inputs, those of them that make an example, memory. Raises MemoryError."""
    resident = psutil.Process().memory_info().rss / 1e6
    print(f"{count} inputs, {read} examples, {resident:.0f} MB", flush=True)
    if resident > MOST_MEMORY:
        raise MemoryError(f"{resident:.0f} MB after {count} inputs")
