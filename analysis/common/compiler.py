"""numba's compiler with its cache in the cache folder: beside the source, its own choice, an installed package lies."""

from __future__ import annotations

import hashlib
import io
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

from numba import config, njit
from numba.core import caching

from ...fmus_src.paths import CACHE
from .machine.cached import find_obstacle, is_sealed, warn_unusable, write_sealed

ONE_AT_A_TIME = threading.Lock()  # folder and kind of files are settings of the whole process


def compile_cached(function: Any, compiler: Any = njit, **options: Any) -> Any:
    """``function`` compiled by one of numba's decorators, and kept for the next process.

    Kept in NUMBA_CACHE_DIR where that is set. Where the folder cannot be written, every process compiles for itself;
    damaged files are written again. A warning says either.
    """
    settings: Any = config  # numba makes its attributes from the environment
    files: Any = caching
    with ONE_AT_A_TIME:
        before = settings.CACHE_DIR, files.IndexDataCacheFile
        folder = Path(before[0] or CACHE / "numba" / _sources(Path(function.__code__.co_filename).parent))
        if (obstacle := find_obstacle(folder)) is not None:
            warn_unusable(folder, obstacle)
            return compiler(**options)(function)
        settings.CACHE_DIR, files.IndexDataCacheFile = str(folder), SealedFiles  # numba looks at both as it decorates
        try:
            return compiler(cache=True, **options)(function)
        finally:
            settings.CACHE_DIR, files.IndexDataCacheFile = before


class SealedFiles(caching.IndexDataCacheFile):
    """Index and data of one function in numba's cache: numba loads whatever there is, and machine code that is damaged
    ends the process.
    """

    def __init__(self, cache_path: str, filename_base: str, source_stamp: Any) -> None:
        super().__init__(cache_path, f"{filename_base}.sealed", source_stamp)

    def save(self, key: Any, compiled: Any) -> None:
        """Write a compiled function, or do without."""
        try:
            super().save(key, compiled)
        except OSError as error:
            warn_unusable(Path(self._cache_path), error)

    def _load_index(self) -> Any:
        return super()._load_index() if is_sealed(Path(self._index_path)) else {}

    def _load_data(self, name: str) -> Any:
        if not is_sealed(Path(self._data_path(name))):
            raise FileNotFoundError  # on which numba compiles
        return super()._load_data(name)

    @contextmanager
    def _open_for_write(self, filepath: str) -> Iterator[io.BytesIO]:
        file = io.BytesIO()
        yield file
        write_sealed(Path(filepath), file.getvalue())  # pickles end where the digest begins


@cache
def _sources(room: Path) -> str:
    """A hash of the sources of a function's room: numba looks at the function's own file, not at its constants'."""
    total = hashlib.sha256()
    for path in sorted(room.glob("*.py")):
        total.update(path.read_bytes())
    return total.hexdigest()[:16]
