"""Files of the cache folder: verified by checksum, written atomically, optional if they cannot be stored.

A damaged file is written again, and an unusable cache is not an error; each of the two is reported once per process.
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

CHECKSUM = ".sha256"  # suffix of the checksum next to a file that other programs open
_substitutes: dict[Path, Path] = {}  # temporary files of this process for those that cannot be stored
_warned: set[str] = set()
_writing = threading.Lock()  # held by a thread that writes a file


def cached_file(path: Path, make: Callable[[], bytes]) -> Path:
    """Return the path of a file of the cache, written with the content from ``make`` if it is missing or damaged.

    ``make`` must always return the same content for a path. If the cache is not writable, the file is temporary and
    belongs to this process. Raises OSError if the temporary file cannot be written either.
    """
    if _has_checksum(path):
        return path
    if path not in _substitutes:
        content = make()
        try:
            with _writing:  # the checksum first: a file without its checksum is not reported as damaged
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
    except OSError:  # missing; other errors occur again when it is written
        return False
    if digest != checksum:
        warn_damaged(path)
    return digest == checksum


def warn_damaged(path: Path) -> None:
    """Warn of a damaged file, which will be written again; once for all files of a cache."""
    home = _cache_of(path.parent)
    warn_once(f"damaged {home}", f"cache {home}: damaged files, such as {path.name}, are written again")


def warn_unusable(folder: Path, error: OSError) -> None:
    """Warn of an unusable cache, once for all of its folders."""
    home = _cache_of(folder)
    warn_once(f"unusable {home}", f"cache {home}: {reason_of(error)}: the cache is not used; {remedy_of(error)}")


def _cache_of(folder: Path) -> Path:
    return CACHE if folder.is_relative_to(CACHE) else folder


def warn_once(subject: str, text: str) -> None:
    """Issue a warning once per process and subject."""
    if subject not in _warned:
        _warned.add(subject)
        warnings.warn(text, stacklevel=3)
