"""How far long work is: a bar on a terminal or in a notebook, nothing elsewhere."""

from __future__ import annotations

from typing import Any

from tqdm.auto import tqdm
from tqdm.std import tqdm as text_bar

IN_NOTEBOOK = any(base.__module__ == "tqdm.notebook" for base in tqdm.__mro__)


def progress_bar(**options: Any) -> text_bar:
    """tqdm's bar with its ``options``, which goes when the work is done."""
    # tqdm asks whether its file is a terminal, which that of a notebook's cell is not
    return tqdm(**options, disable=False if IN_NOTEBOOK else None, leave=False)
