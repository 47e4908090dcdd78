"""numba's compiler with its cache in the cache folder: beside the source, its own choice, an installed package lies."""

from __future__ import annotations

import hashlib
import tempfile
import threading
import warnings
from functools import cache
from pathlib import Path
from typing import Any

from numba import config, njit

from ...fmus_src.paths import CACHE

ONE_AT_A_TIME = threading.Lock()  # the folder is a setting of the whole process


def compile_cached(function: Any, compiler: Any = njit, **options: Any) -> Any:
    """``function`` compiled by one of numba's decorators, and kept for the next process.

    Kept in NUMBA_CACHE_DIR where that is set. Where the cache folder cannot be written, every process compiles for
    itself, which a warning says.
    """
    settings: Any = config  # numba makes its attributes from the environment
    with ONE_AT_A_TIME:
        if settings.CACHE_DIR:
            return compiler(cache=True, **options)(function)
        folder = CACHE / "numba" / _sources(Path(function.__code__.co_filename).parent)
        if not _is_writable(folder):
            warnings.warn(f"{folder} cannot be written: compiled anew; set NUMBA_CACHE_DIR to a folder", stacklevel=2)
            return compiler(**options)(function)
        settings.CACHE_DIR = str(folder)  # numba looks at it while it decorates
        try:
            return compiler(cache=True, **options)(function)
        finally:
            settings.CACHE_DIR = ""


@cache
def _sources(room: Path) -> str:
    """A hash of the sources of a function's room: numba looks at the function's own file, not at its constants'."""
    total = hashlib.sha256()
    for path in sorted(room.glob("*.py")):
        total.update(path.read_bytes())
    return total.hexdigest()[:16]


def _is_writable(folder: Path) -> bool:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False
