"""Which FMUs are Perilune's own: known by the SHA-256 of their files, never by what they say of themselves.

The lists have the format of sha256sum. `build_fmus.py` writes one into each folder that it builds, which the wheel
ships; whatever is built on this machine is noted in the cache folder besides. All other FMUs are foreign code.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

from ..analysis.common.atomic import write_atomically
from .paths import CACHE, FLAVOURS, shipped_fmu

SUMS = "SHA256SUMS"
NOTED = CACHE / SUMS
LISTS = (NOTED, *(shipped_fmu("", flavour).with_name(SUMS) for flavour in FLAVOURS))


def is_own(digest: str) -> bool:
    """Whether the FMU with this SHA-256 is one that Perilune built."""
    return any(digest in _digests_in(path, *_version(path)) for path in LISTS)


def note_own(path: Path) -> None:
    """Add the FMU that was just built at ``path`` to the list of this machine."""
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    if not is_own(digest):
        NOTED.parent.mkdir(parents=True, exist_ok=True)
        with NOTED.open("a", encoding="utf-8", newline="\n") as file:  # one write: processes may build side by side
            file.write(f"{digest}  {path.name}\n")


def list_own(folder: Path, paths: Iterable[Path]) -> None:
    """Write the list of the FMUs that were just built in a folder, in place of the one before."""
    lines = [f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n" for path in sorted(paths)]
    write_atomically(folder / SUMS, "".join(lines).encode())


def _version(path: Path) -> tuple[int, int]:
    """What changes with a file's content; of one that is not there, nothing."""
    try:
        stat = path.stat()
    except FileNotFoundError:
        return 0, 0
    return stat.st_mtime_ns, stat.st_size


@lru_cache(maxsize=2 * len(LISTS))
def _digests_in(path: Path, _time: int, size: int) -> frozenset[str]:
    return frozenset(line[:64] for line in path.read_text(encoding="utf-8").splitlines()) if size else frozenset()
