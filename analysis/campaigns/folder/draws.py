"""Table of draws in a campaign's folder, read in blocks."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet

from ....common.errors import InputError
from ....common.machine.arrow import numpy_of
from ....common.regular import check_regular
from ..draws.table import DrawTable
from .campaign_manifest import COPY_AGAIN
from .shard_files import DRAWS, check_names


@dataclass(frozen=True)
class StoredDraws:
    """Draws of the first ``trials`` trials, with these ``names``, in the file at ``path``."""

    path: Path
    trials: int
    names: tuple[str, ...]

    def of_first(self, trials: int) -> StoredDraws:
        return replace(self, trials=trials)

    def of_part(self, trials: range) -> DrawTable:
        """Return the samples of consecutive trials, renumbered from 0. Raises InputError if the file is damaged."""
        with _open_draws(self.path) as file:
            ends = np.cumsum([file.metadata.row_group(group).num_rows for group in range(file.num_row_groups)])
            groups = range(
                int(np.searchsorted(ends, trials.start, side="right")), int(np.searchsorted(ends, trials.stop)) + 1
            )
            table = file.read_row_groups(list(groups), list(self.names))
        first = trials.start - (int(ends[groups.start - 1]) if groups.start else 0)
        rows = slice(first, first + len(trials))
        return DrawTable(len(trials), {name: numpy_of(table[name])[rows] for name in self.names})


def read_draws(folder: Path, trials: int, names: list[str]) -> StoredDraws:
    """Return the draws of a folder's first trials. Raises InputError if it does not contain all of them."""
    path = folder / DRAWS
    with _open_draws(path) as file:
        there, rows = file.schema_arrow.names, file.metadata.num_rows
    check_names(there, path)
    missing = [name for name in names if name not in there]
    if missing or rows < trials:
        problem = f"lacks column {missing[0]}" if missing else f"has {rows} rows for {trials}"
        raise InputError(path, "", problem, COPY_AGAIN)
    return StoredDraws(path, trials, tuple(names))


@contextmanager
def _open_draws(path: Path) -> Iterator[pyarrow.parquet.ParquetFile]:
    check_regular(path, COPY_AGAIN)
    try:
        with pyarrow.parquet.ParquetFile(path, page_checksum_verification=True) as file:
            yield file
    except (OSError, ValueError, pyarrow.ArrowException) as error:
        raise InputError(path, "", "cannot be read as parquet", COPY_AGAIN) from error
