"""Files of the cache folder: read by their checksums, written whole, optional where they cannot be stored.

A damaged file is written again, and a cache that cannot be used ends nothing: either is reported in one line for a
process.
"""

from __future__ import annotations

import hashlib
import threading
import warnings
from collections.abc import Callable
from pathlib import Path

from ..atomic import write_atomically
from ..paths import CACHE
from ..scratch import make_folder
from .os_errors import reason_of, remedy_of

CHECKSUM = ".sha256"  # of the file next to one that other programs open
_substitutes: dict[Path, Path] = {}  # of files that cannot be kept: temporary ones of this process
_warned: set[str] = set()
_writing = threading.Lock()  # of threads that make one file at once


def cached_file(path: Path, make: Callable[[], bytes]) -> Path:
    """Return a file of the cache, which ``make`` gives the content of where it is missing or damaged.

    The same input has to give the same content. Where the cache cannot be written the file is a temporary one, for
    this process. Raises OSError where that cannot be written either.
    """
    if _has_checksum(path):
        return path
    if path not in _substitutes:
        content = make()
        try:
            with _writing:  # the checksum first: a file without one is not said to be damaged
                write_atomically(path.with_suffix(CHECKSUM), hashlib.sha256(content).hexdigest().encode())
                write_atomically(path, content)
        except OSError as error:
            warn_unusable(path.parent, error)
            substitute = make_folder() / path.name
            substitute.write_bytes(content)
            _substitutes[path] = substitute
        else:
            return path
    return _substitutes[path]


def _has_checksum(path: Path) -> bool:
    try:
        checksum = path.with_suffix(CHECKSUM).read_bytes()
        digest = hashlib.sha256(path.read_bytes()).hexdigest().encode()
    except OSError:  # missing, or found out when it is written
        return False
    if digest != checksum:
        warn_damaged(path)
    return digest == checksum


def warn_damaged(path: Path) -> None:
    """Warn of a damaged file, which is written again; once for all files of a cache."""
    home = _cache_of(path.parent)
    warn_once(f"damaged {home}", f"cache {home}: damaged files are made again, {path.name} for one")


def warn_unusable(folder: Path, error: OSError) -> None:
    """Warn of a cache that cannot be used, once for all of its folders."""
    home = _cache_of(folder)
    warn_once(f"unusable {home}", f"cache {home}: {reason_of(error)}: done without; {remedy_of(error)}")


def _cache_of(folder: Path) -> Path:
    return CACHE if folder.is_relative_to(CACHE) else folder


def warn_once(subject: str, text: str) -> None:
    """Warn with a text, once in a process for a subject."""
    if subject not in _warned:
        _warned.add(subject)
        warnings.warn(text, stacklevel=3)
