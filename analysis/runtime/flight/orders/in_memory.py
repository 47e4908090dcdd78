"""Direct access to values in the memory of Perilune's native FMUs between steps."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...loop import codes
from .instruction_rows import Callee

REAL_SIZE = 8  # bytes


class SlotRun(NamedTuple):
    """Consecutive slots with values that are contiguous in an FMU's memory, from ``address`` on."""

    address: int
    first: int
    size: int


def runs_in_memory(
    instance: Callee, references: np.ndarray, first: int, kind: str, *, to_set: bool = False
) -> list[SlotRun]:
    """Return the contiguous runs of values with these value references (uint32), with slots numbered from ``first``.

    The list is empty if the FMU does not disclose the address of every value.
    """
    ends = [0, *(np.flatnonzero(np.diff(references.astype(np.int64)) != 1) + 1).tolist(), references.size]
    runs = []
    for start, end in itertools.pairwise(ends):
        address = instance.locate(references[start:end], kind, to_set=to_set)
        if not address:
            return []
        runs.append(SlotRun(address, first + start, end - start))
    return runs


def with_moves(rows: Sequence[list[int]], runs: Sequence[SlotRun], component: int, instance: int) -> list[list[int]]:
    """Return instructions that write connected values to the slots of these runs and to the FMU's memory.

    The list is empty if ``rows`` contain other instructions than plain copies, or do not cover all slots.
    """
    moved = []
    left = sum(run.size for run in runs)
    for row in rows:
        code, source, _, target, count, *_ = row
        if code != codes.COPY:
            return []
        for run in runs:
            if run.first <= target and target + count <= run.first + run.size:
                address = run.address + REAL_SIZE * (target - run.first)
                row = [codes.MOVE_REAL, address, instance, target, count, component, source]
                left -= count
        moved.append(row)
    return [] if left else moved
