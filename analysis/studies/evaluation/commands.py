"""Command lines that fly again what a study has flown; who writes them is not known here."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple


class Commands(NamedTuple):
    """``replay`` flies a trial of a file of draws again, ``monte_carlo`` so many trials of the campaign itself."""

    replay: Callable[[Path, int], str]
    monte_carlo: Callable[[int], str]
