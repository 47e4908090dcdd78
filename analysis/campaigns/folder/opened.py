"""Trials of a campaign's folder, read on demand."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cached_property
from typing import Any

import numpy as np
import pyarrow
import pyarrow.compute
import pyarrow.dataset
from pyarrow.fs import LocalFileSystem

from ....common.errors import suggestion
from ..statistics import quantile
from ..trial_columns import Column, describe_column
from .campaign_folder import CampaignFolder
from .provenance import CampaignProvenance
from .shard_files import read_table
from .traces import trace_dataset

UNKNOWN = re.compile(r"FieldRef\.Name\((.+?)\)")  # Arrow's message for a missing column


class OpenedResults:
    """Trials of a campaign's folder; ``source`` is the folder as of the time when it was opened."""

    def __init__(self, source: CampaignFolder) -> None:
        self.source = source

    @property
    def provenance(self) -> CampaignProvenance:
        """Inputs that determine the numbers, as in summary.json: system, campaign, seed, hashes."""
        return self.source.provenance

    @property
    def variants(self) -> list[str]:
        """Names of the campaign's variants."""
        return self.source.variants

    @property
    def trials(self) -> int:
        """Number of the campaign's trials of each variant."""
        return int(self.provenance["trials"])

    @property
    def flown(self) -> int:
        """Number of stored trials of each variant, which is below `trials` while the campaign is running."""
        return self.source.flown

    @cached_property
    def dataset(self) -> pyarrow.dataset.Dataset:
        """Shards as one pyarrow.dataset, with units in the metadata of its columns; checksums are verified."""
        scan = pyarrow.dataset.ParquetFragmentScanOptions(page_checksum_verification=True)
        return pyarrow.dataset.dataset(
            [str(shard.path) for shard in self.source.shards],
            schema=self._schema,
            format=pyarrow.dataset.ParquetFileFormat(default_fragment_scan_options=scan),
            filesystem=LocalFileSystem(),  # otherwise a path with a colon would be interpreted as an address
        )

    @cached_property
    def columns(self) -> dict[str, Column]:
        """Unit and meaning of every column, in order."""
        names = self._stored_schema.names
        return {name: describe_column(name, self.provenance) for name in names}

    @cached_property
    def _stored_schema(self) -> pyarrow.Schema:
        return self.source.schema(self.source.shards[0])

    @cached_property
    def _schema(self) -> pyarrow.Schema:
        fields = self._stored_schema.remove_metadata()
        units = {name: column.unit for name, column in self.columns.items()}
        return pyarrow.schema(
            [field.with_metadata({"unit": units[field.name]}) if units[field.name] else field for field in fields]
        )

    def arrow(
        self, columns: Sequence[str] | None = None, where: pyarrow.compute.Expression | None = None
    ) -> pyarrow.Table:
        """Return a row for each variant and trial for which ``where`` is true (default: all), with some ``columns``.

        ``where`` is an expression over any columns, such as ``pyarrow.compute.field("metric.miss") > 10``. Raises
        KeyError for a missing column, InputError for a damaged shard.
        """
        self._check(columns)
        with self._describe():
            return self.dataset.to_table(columns=None if columns is None else list(columns), filter=where)

    def batches(
        self, columns: Sequence[str] | None = None, where: pyarrow.compute.Expression | None = None
    ) -> Iterator[pyarrow.RecordBatch]:
        """Yield the rows of `arrow` in order and in batches, in bounded memory. Raises the errors of `arrow`."""
        self._check(columns)
        names = self._schema.names if columns is None else list(columns)
        with self._describe():
            # shard by shard: to_batches of the dataset reads ahead, and Arrow 26 may crash if iteration ends early
            for shard in self.dataset.get_fragments():
                table = shard.to_table(self._schema, names, filter=where, use_threads=False, cache_metadata=False)
                yield from table.to_batches()

    def quantile(
        self, metric: str, share: float, variant: str | None = None, *, where: pyarrow.compute.Expression | None = None
    ) -> float:
        """Return the least value of a metric that a ``share`` of the trials does not exceed.

        The result is exact, and memory is bounded. As for the quantiles in summary.json, trials with infinite values
        count, but not trials with nan. With ``where``, only trials for which it is true count, as in `arrow`. The
        result is nan if no trial counts. ``variant`` may be omitted if the campaign has only one. Raises KeyError for
        an unknown metric or variant, ValueError for an invalid share.
        """
        name = f"metric.{metric}"
        if metric not in self.provenance["metrics"]:
            raise KeyError(f"no metric {metric}; {suggestion(metric, self.provenance['metrics'])}")
        mine = pyarrow.compute.field("variant") == self._variant(variant)
        chosen = mine if where is None else mine & where

        def values() -> Iterator[np.ndarray]:
            for batch in self.batches([name], chosen):
                yield batch.column(0).to_numpy(zero_copy_only=False).astype(np.float64)

        return quantile(values, share)

    def traces(self, variant: str | None = None, names: Sequence[str] | None = None) -> Any:
        """Return a variant's recorded signals over time, an xarray.Dataset over (trial, time).

        Values are nan after the end of a trial. ``names`` selects signals, by default all; units are in ``attrs``.
        Raises KeyError for an unknown signal or variant, and if the campaign records no traces; ImportError without
        xarray.
        """
        return trace_dataset(self.source, self._variant(variant), names)

    def _variant(self, variant: str | None) -> str:
        if variant is None and len(self.variants) > 1:
            raise KeyError(f"the campaign has several variants; name one of {', '.join(self.variants)}")
        if variant is not None and variant not in self.variants:
            raise KeyError(f"no variant {variant}; {suggestion(variant, self.variants)}")
        return variant or self.variants[0]

    def _check(self, columns: Sequence[str] | None) -> None:
        for name in columns or ():
            if name not in self.columns:
                raise KeyError(f"no column {name}; {suggestion(name, self.columns)}")

    @contextmanager
    def _describe(self) -> Iterator[None]:
        """Translate errors of Arrow for a missing column in ``where``, and for a damaged shard."""
        try:
            yield
        except (OSError, pyarrow.ArrowException) as error:
            unknown = UNKNOWN.search(str(error))
            if unknown is not None:
                self._check([unknown[1]])
            for shard in self.source.shards:
                read_table(shard.path)  # raises an error that names the damaged shard
            raise
