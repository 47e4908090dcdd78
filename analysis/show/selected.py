"""Selected trials as a file of comma-separated values: every quantity in SI, with all digits."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence

import numpy as np
import pyarrow.csv

from .campaign import OpenCampaign


def selected_csv(campaign: OpenCampaign, mask: np.ndarray, names: Sequence[str]) -> Iterator[bytes]:
    """Yield the file, a chunk for each shard: a head, then the rows of a ``mask`` (rows,).

    Raises InputError for damaged files, StoppedError at the server's end.
    """
    has_head = False
    for table in campaign.read_selected(mask, names):
        buffer = io.BytesIO()
        pyarrow.csv.write_csv(table, buffer, pyarrow.csv.WriteOptions(include_header=not has_head))
        has_head = True
        yield buffer.getvalue()
