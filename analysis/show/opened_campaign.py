"""A campaign's folder for display: its variants, its quantities, and rows of its trial files."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet

from ...common.errors import InputError
from ..campaigns.execute.loaded_campaign import read_folder
from ..campaigns.folder.campaign_folder import CampaignFolder
from ..campaigns.folder.shard_files import IDENTITY, NEW_FOLDER, NUMBER_PREFIXES, check_names, numbers
from ..campaigns.trial_columns import Column, describe_column
from ..commands.campaigns import replay_of_folder

ROW_LIMIT = 20_000_000  # rows of a campaign; a column then takes 40 MB
NUMERIC = ("end_time",)
ORDER = ("metric", "draw", "final", "end_time", "fault")
DETAILS = ("status", "success")  # columns of a trial in addition to numbers


class StoppedError(Exception):
    """Error that ends the reading of data when the server has stopped."""


@dataclass(frozen=True)
class OpenCampaign:
    """The shards of a folder as of its opening.

    Rows are numbered across all shards: within a shard by variant, within a variant by trial.
    """

    source: CampaignFolder
    is_stopped: Callable[[], bool] = lambda: False

    @property
    def variants(self) -> list[str]:
        return self.source.variants

    @cached_property
    def starts(self) -> list[int]:
        """The first row of each shard, followed by the number of all rows."""
        starts = [0]
        for shard in self.source.shards:
            starts.append(starts[-1] + len(shard.trials) * len(self.variants))
        return starts

    @property
    def rows(self) -> int:
        return self.starts[-1]

    @cached_property
    def quantities(self) -> dict[str, Column]:
        """Unit and description of every numeric column: metrics, samples, final values, end time, faults.

        Raises InputError for a column that the campaign does not declare.
        """
        path = self.source.shards[0].path
        schema = pyarrow.parquet.read_schema(path)
        check_names(schema.names, path)
        named = [name for name in schema.names if _is_number(schema, name)]
        ordered = sorted(named, key=lambda name: ORDER.index(name.partition(".")[0]))
        try:
            return {name: describe_column(name, self.source.provenance) for name in ordered}
        except (KeyError, TypeError, AttributeError) as error:
            problem = f"the campaign's summary does not declare {error}"
            raise InputError(path, "", problem, NEW_FOLDER) from error

    @cached_property
    def variant_numbers(self) -> np.ndarray:
        """The index of each row's variant, (rows,)."""
        kind = np.uint8 if len(self.variants) < 256 else np.uint16
        shards = self.source.shards
        return np.concatenate(
            [np.repeat(np.arange(len(self.variants), dtype=kind), len(shard.trials)) for shard in shards]
        )

    def read(self, names: Sequence[str]) -> dict[str, np.ndarray]:
        """Read columns of all rows as doubles, (rows,) each.

        Raises InputError for damaged files, StoppedError after the server stopped.
        """
        columns = {name: np.empty(self.rows) for name in names}
        for shard, start in zip(self.source.shards, self.starts, strict=False):
            if self.is_stopped():
                raise StoppedError
            table = self.source.read(shard, names)
            for name, column in columns.items():
                column[start : start + table.num_rows] = numbers(table, name, shard.path)
        return columns

    def read_rows(self, rows: Sequence[int], names: Sequence[str]) -> Iterator[dict[str, object]]:
        """Yield the entries of ascending rows: variant, trial, numeric columns and `DETAILS`. Raises InputError."""
        table, current = None, -1
        for row in rows:
            number = bisect_right(self.starts, row) - 1
            if number != current:
                table, current = self.source.read(self.source.shards[number], [*names, *DETAILS]), number
            assert table is not None
            (entries,) = table.slice(row - self.starts[number], 1).to_pylist()
            yield entries

    def read_selected(self, mask: np.ndarray, names: Sequence[str]) -> Iterator[pyarrow.Table]:
        """Yield a table per shard with the rows of ``mask`` (rows,): identity, `DETAILS`, columns.

        Raises as `read` does.
        """
        for shard, start in zip(self.source.shards, self.starts, strict=False):
            if self.is_stopped():
                raise StoppedError
            rows = mask[start : start + len(shard.trials) * len(self.variants)]
            if rows.any():
                columns = [*IDENTITY, *DETAILS, *names]
                yield self.source.read(shard, [*names, *DETAILS]).select(columns).filter(pyarrow.array(rows))

    def command(self, variant: str, trial: int) -> str:
        """Return the command that repeats a trial."""
        return replay_of_folder(self.source.folder, self.variants, variant, trial)


def _is_number(schema: pyarrow.Schema, name: str) -> bool:
    kind = schema.field(name).type
    is_numeric = pyarrow.types.is_floating(kind) or pyarrow.types.is_integer(kind) or pyarrow.types.is_boolean(kind)
    return is_numeric and (name in NUMERIC or name.startswith(NUMBER_PREFIXES))


def open_campaign(folder: Path, is_stopped: Callable[[], bool]) -> OpenCampaign:
    """Open a campaign's folder, complete or unfinished.

    Raises InputError for any other folder, a link inside, damage, and more than `ROW_LIMIT` rows.
    """
    campaign = OpenCampaign(read_folder(folder), is_stopped)
    if campaign.rows > ROW_LIMIT:
        problem = f"all variants together have {campaign.rows} trials, but at most {ROW_LIMIT} can be shown"
        raise InputError(
            folder, "", problem, "query its parquet files as `perilune docs` describes under Querying results"
        )
    _ = campaign.quantities
    return campaign
