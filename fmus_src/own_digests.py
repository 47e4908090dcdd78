"""Registry of Perilune's own FMUs, recognised by the SHA-256 of their files and never by their declarations.

The lists have the format of sha256sum. `build_fmus.py` writes one into each folder that it builds, and the wheel ships
them; a list in the cache folder contains all FMUs built on this machine. All other FMUs are foreign code.
"""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

from ..common.atomic import write_atomically
from ..common.bounds import ARCHIVE_BYTES, INPUT_BYTES
from ..common.errors import InputError
from ..common.machine.cached import warn_once, warn_unusable
from ..common.paths import CACHE, FLAVOURS, names_fmu, shipped_fmu
from ..common.regular import read_input
from ..common.zips import ZippedFiles

SUMS = "SHA256SUMS"
NOTED = CACHE / SUMS
LINE = re.compile(rb"([0-9a-f]{64}) [ *].")
LISTS = (NOTED, *(shipped_fmu("", flavour).with_name(SUMS) for flavour in FLAVOURS))
_built_here: set[str] = set()  # digests of FMUs for which no list could be written


def digest_of(path: Path) -> str:
    """Return the SHA-256 of a file as hexadecimal digits."""
    return _digest(path.read_bytes())


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def is_own(digest: str) -> bool:
    """Return True if the FMU with this SHA-256 was built by Perilune."""
    return digest in _built_here or any(digest in _digests_in(path, *_version(path)) for path in LISTS)


def has_foreign(path: Path) -> bool:
    """Return True if an FMU, an .ssp or the FMUs in a folder's subfolders are not all built by Perilune.

    A path that cannot be read gives False.
    """
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
    """Add a newly built FMU to the list of this machine or, if the list cannot be written, to this process's list."""
    digest = digest_of(path)
    if is_own(digest):
        return
    try:
        NOTED.parent.mkdir(parents=True, exist_ok=True)
        line = _line(digest, path)
        # A single write, since processes may build concurrently, on a new line if the last line is incomplete.
        with NOTED.open("ab+") as file:
            size = file.seek(0, os.SEEK_END)
            file.seek(max(size - 1, 0))
            file.write(line if file.read() in (b"", b"\n") else b"\n" + line)
    except OSError as error:
        warn_unusable(NOTED.parent, error)
        _built_here.add(digest)


def list_own(folder: Path, paths: Iterable[Path]) -> None:
    """Write the list of a folder's newly built FMUs, replacing the previous one."""
    write_atomically(folder / SUMS, b"".join(_line(digest_of(path), path) for path in sorted(paths)))


def _line(digest: str, path: Path) -> bytes:
    """Return a line of a list in the format of sha256sum, with the file name in the bytes of the file system."""
    return f"{digest}  ".encode() + os.fsencode(path.name) + b"\n"


def _version(path: Path) -> tuple[int, int]:
    """Return modification time (ns) and size (bytes) of a list, which identify its version; (0, 0) without the file."""
    try:
        stat = path.stat()
    except FileNotFoundError:
        return 0, 0
    except OSError as error:
        warn_unusable(path.parent, error)
        return 0, 0
    return stat.st_mtime_ns, stat.st_size


@lru_cache(maxsize=2 * len(LISTS))
def _digests_in(path: Path, _time: int, size: int) -> frozenset[str]:
    """Return the digests of a list; lines that do not have the format of sha256sum are ignored with a warning."""
    if not size:
        return frozenset()
    try:
        lines = read_input(path, "remove it", INPUT_BYTES).splitlines()
    except InputError as error:
        warn_once(str(path), f"{error}; until then its FMUs are foreign")
        return frozenset()
    matches = [LINE.match(line) for line in lines]
    damaged = [number for number, match in enumerate(matches, start=1) if match is None and lines[number - 1]]
    if damaged:
        more = f" and {len(damaged) - 1} more" if len(damaged) > 1 else ""
        problem = f"line {damaged[0]}{more} not in the format of sha256sum: ignored"
        warn_once(str(path), f"{path}: {problem}; remove the file and build its FMUs again")
    return frozenset(match[1].decode() for match in matches if match is not None)
