"""Individual trials: dots of a figure, rows of a table, all numbers of one trial."""

from __future__ import annotations

import base64
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from .documents import DotsDocument, TrialEntry
from .opened_campaign import OpenCampaign

DOT_LIMIT = 20_000  # trials that a figure shows one by one
TABLE_LIMIT = 50  # rows of the table of selected trials


def dots_of(rows: np.ndarray, x: np.ndarray, y: np.ndarray, success: np.ndarray, variants: np.ndarray) -> DotsDocument:
    """Return row numbers, bins, outcomes and variants of trials, (dots,) each, for the page."""
    return {
        "rows": _text(rows.astype("<u4")),
        "x": _text(x.astype("<u2")),
        "y": _text(y.astype("<u2")),
        "success": _text(success.astype("u1")),
        "variants": _text(variants.astype("<u2")),
    }


def _text(numbers: np.ndarray) -> str:
    return base64.b64encode(numbers.tobytes()).decode("ascii")


def trials_document(campaign: OpenCampaign, rows: Sequence[int], names: Sequence[str]) -> list[TrialEntry]:
    """Return trials with some of their numbers. Raises InputError for damaged files."""
    return [
        {
            "row": row,
            "trial": int(str(entries["trial"])),
            "variant": str(entries["variant"]),
            "success": bool(entries["success"]),
            "status": str(entries["status"]),
            "command": campaign.command(str(entries["variant"]), int(str(entries["trial"]))),
            "numbers": [_exact(entries[name]) for name in names],
        }
        for row, entries in zip(rows, campaign.read_rows(rows, names), strict=True)
    ]


def _exact(number: Any) -> float | str | None:
    if math.isfinite(number):
        return float(number)
    return None if math.isnan(number) else str(number)
