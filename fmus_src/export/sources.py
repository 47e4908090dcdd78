"""Record of the source files of a user's FMUs, in sources.json next to the FMUs, to detect changes.

File names are relative to the folder of sources.json and valid on any machine; FMUs and sources are identified by their
SHA-256.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from ..own_digests import digest_of

NAME = "sources.json"


def record_source(folder: Path, source: Path, fmus: Sequence[Path], others: Iterable[Path] = ()) -> None:
    """Record that ``fmus`` in ``folder``/FLAVOUR were built from a file and others of its folder."""
    try:
        place = _relative(source, folder)
    except ValueError:  # on another drive, without a relative path
        return
    known = _read(folder)
    built_of = {"source": place, "sha256": digest_of(source)}
    digests = {_relative(other, folder): digest_of(other) for other in others}
    for fmu in fmus:
        known[_relative(fmu, folder)] = {"fmu": digest_of(fmu), **built_of, "others": digests}
    (folder / NAME).write_text(json.dumps(dict(sorted(known.items())), indent=1) + "\n", encoding="utf-8")


def remove_outdated(folder: Path, source: Path, fmu: Path) -> None:
    """Remove an FMU whose source file no longer defines it, since it would take precedence over other FMUs."""
    entry = _read(folder).get(_relative(fmu, folder))
    if entry is None or not fmu.is_file():
        return
    if digest_of(fmu) == entry["fmu"] and entry["source"] == _relative(source, folder):
        fmu.unlink()


def find_changed_source(fmu: Path) -> tuple[Path, Path] | None:
    """Return the first file changed since the FMU was built from it, and the file to export again.

    Returns None if no change is certain.
    """
    folder = fmu.resolve().parents[1]
    entry = _read(folder).get(f"{fmu.resolve().parent.name}/{fmu.name}")
    if entry is None or not fmu.is_file() or digest_of(fmu) != entry["fmu"]:
        return None
    source = Path(os.path.normpath(folder / entry["source"]))
    for name, digest in {entry["source"]: entry["sha256"], **entry.get("others", {})}.items():
        file = Path(os.path.normpath(folder / name))
        if file.is_file() and digest_of(file) != digest:
            return file, source
    return None


def _relative(path: Path, folder: Path) -> str:
    return Path(os.path.relpath(path.resolve(), folder.resolve())).as_posix()


def _read(folder: Path) -> dict[str, Any]:
    try:
        return json.loads((folder / NAME).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
