"""Of which file an FMU of one's own was built: kept in sources.json beside the FMUs, so that a change is noticed.

Files are named from the folder of sources.json, whatever machine it lies on; FMUs and sources by their SHA-256.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

NAME = "sources.json"


def record_source(folder: Path, source: Path, fmus: Sequence[Path]) -> None:
    """Write down that ``fmus``, which lie in ``folder``/FLAVOUR, were built of a file."""
    try:
        place = Path(os.path.relpath(source.resolve(), folder.resolve())).as_posix()
    except ValueError:  # on another drive, to which no way leads from here
        return
    known = _read(folder)
    for fmu in fmus:
        known[fmu.relative_to(folder).as_posix()] = {"fmu": _digest(fmu), "source": place, "sha256": _digest(source)}
    (folder / NAME).write_text(json.dumps(dict(sorted(known.items())), indent=1) + "\n", encoding="utf-8")


def changed_source(fmu: Path) -> Path | None:
    """The file that an FMU was built of, if it has other content by now; None where that is not certain."""
    folder = fmu.resolve().parents[1]
    entry = _read(folder).get(f"{fmu.resolve().parent.name}/{fmu.name}")
    if entry is None or not fmu.is_file() or _digest(fmu) != entry["fmu"]:
        return None
    source = folder / entry["source"]
    if not source.is_file() or _digest(source) == entry["sha256"]:
        return None
    return Path(os.path.normpath(source))


def _read(folder: Path) -> dict[str, Any]:
    try:
        return json.loads((folder / NAME).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
