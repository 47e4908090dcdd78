"""Document of the propellant bounds of a campaign's trials."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ...model import Document, Listing, Text


def trial_bounds_document(
    campaign: str, propellant: np.ndarray, duration: np.ndarray, intervals: int, file: Path | None
) -> Document:
    """Return the document of bounds on ``propellant`` (kg) and their ``duration`` (s), (trials,), NaN if unknown.

    ``file`` is the stored table, if any.
    """
    known = propellant[np.isfinite(propellant)]
    rows = []
    if known.size:
        mean, low, high = math.fsum(known) / known.size, known.min(), known.max()
        rows.append([f"bound {mean:.3f} kg on average, {low:.3f} to {high:.3f} kg"])
    summary = Listing(rows, f"{campaign}: {propellant.size} trials ({intervals} intervals)")
    stored = [] if file is None else [Text(f"stored: {file}")]
    columns = {"propellant_kg": propellant, "duration_s": duration}
    lists = {name: [x if math.isfinite(x) else None for x in column.tolist()] for name, column in columns.items()}
    json = {"campaign": campaign, "intervals": intervals, **lists}
    return Document(f"Bounds of {campaign}", [summary, *stored], [], json)
