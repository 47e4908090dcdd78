"""Selected trials as a CSV file: every quantity in SI with all digits."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence

import numpy as np
import pyarrow.csv

from .opened_campaign import OpenCampaign


def selected_csv(campaign: OpenCampaign, mask: np.ndarray, names: Sequence[str]) -> Iterator[bytes]:
    """Yield the file in chunks: a header, then for each shard the rows selected by ``mask`` (rows,).

    Raises InputError for damaged files, StoppedError after the server stopped.
    """
    has_head = False
    for table in campaign.read_selected(mask, names):
        buffer = io.BytesIO()
        pyarrow.csv.write_csv(table, buffer, pyarrow.csv.WriteOptions(include_header=not has_head))
        has_head = True
        yield buffer.getvalue()
