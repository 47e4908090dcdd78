"""numba's compiler with its cache in the cache folder: beside the source, its own choice, an installed package lies."""

from __future__ import annotations

import hashlib
import tempfile
import warnings
from functools import cache
from pathlib import Path
from typing import Any

from numba import config, njit

from .....fmus_src.paths import CACHE


def compile_cached(function: Any, **options: Any) -> Any:
    """``function`` compiled at its first call, and kept for the next process.

    Kept in NUMBA_CACHE_DIR where that is set. Where the cache folder cannot be written, every process compiles for
    itself, which a warning says.
    """
    settings: Any = config  # numba makes its attributes from the environment
    if settings.CACHE_DIR:
        return njit(cache=True, **options)(function)
    folder = CACHE / "numba" / _sources()
    if not _is_writable(folder):
        warnings.warn(f"{folder} cannot be written: compiled anew; set NUMBA_CACHE_DIR to a folder", stacklevel=2)
        return njit(**options)(function)
    settings.CACHE_DIR = str(folder)  # numba looks at it while it decorates
    try:
        return njit(cache=True, **options)(function)
    finally:
        settings.CACHE_DIR = ""


@cache
def _sources() -> str:
    """What tells this room's sources from others: numba looks at a function's own file, not at its constants'."""
    total = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        total.update(path.read_bytes())
    return total.hexdigest()[:16]


def _is_writable(folder: Path) -> bool:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False
