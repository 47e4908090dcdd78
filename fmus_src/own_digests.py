"""Which FMUs are Perilune's own: known by the SHA-256 of their files, never by what they say of themselves.

The lists have the format of sha256sum. `build_fmus.py` writes one into each folder that it builds, which the wheel
ships; a list in the cache folder has whatever was built on this machine. All other FMUs are foreign code.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

from ..analysis.common.atomic import write_atomically
from ..analysis.common.bounds import ARCHIVE_BYTES
from ..analysis.common.errors import InputError
from ..analysis.common.regular import read_input
from ..analysis.common.zips import ZippedFiles
from .paths import CACHE, FLAVOURS, names_fmu, shipped_fmu

SUMS = "SHA256SUMS"
NOTED = CACHE / SUMS
LISTS = (NOTED, *(shipped_fmu("", flavour).with_name(SUMS) for flavour in FLAVOURS))


def digest_of(path: Path) -> str:
    """SHA-256 of a file, in hexadecimal digits."""
    return _digest(path.read_bytes())


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def is_own(digest: str) -> bool:
    """Whether the FMU with this SHA-256 is one that Perilune built."""
    return any(digest in _digests_in(path, *_version(path)) for path in LISTS)


def has_foreign(path: Path) -> bool:
    """Whether a file, or a folder with its subfolders, has FMUs that Perilune has not built; False where unreadable."""
    try:
        if names_fmu(path):
            return not is_own(_digest(read_input(path, "", ARCHIVE_BYTES)))
        if path.is_dir():
            return any(has_foreign(fmu) for fmu in path.glob("*/*.fmu"))
        if path.suffix == ".ssp":
            files = ZippedFiles(read_input(path, "", ARCHIVE_BYTES), path.name)
            return not all(is_own(_digest(files[name])) for name in files if names_fmu(name))
    except (OSError, InputError):
        pass
    return False


def note_own(path: Path) -> None:
    """Add the FMU that was just built at ``path`` to the list of this machine."""
    digest = digest_of(path)
    if not is_own(digest):
        NOTED.parent.mkdir(parents=True, exist_ok=True)
        # One write, since several processes may build at once.
        with NOTED.open("a", encoding="utf-8", newline="\n") as file:
            file.write(f"{digest}  {path.name}\n")


def list_own(folder: Path, paths: Iterable[Path]) -> None:
    """Write the list of the FMUs that were just built in a folder, in place of the one before."""
    lines = [f"{digest_of(path)}  {path.name}\n" for path in sorted(paths)]
    write_atomically(folder / SUMS, "".join(lines).encode())


def _version(path: Path) -> tuple[int, int]:
    """Time of change (ns) and size (bytes) of a list, by which a new version is recognised; 0, 0 without the file."""
    try:
        stat = path.stat()
    except FileNotFoundError:
        return 0, 0
    return stat.st_mtime_ns, stat.st_size


@lru_cache(maxsize=2 * len(LISTS))
def _digests_in(path: Path, _time: int, size: int) -> frozenset[str]:
    return frozenset(line[:64] for line in path.read_text(encoding="utf-8").splitlines()) if size else frozenset()
