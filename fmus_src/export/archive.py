"""Zip archives whose bytes depend only on the archived files."""

from __future__ import annotations

import hashlib
import zipfile
from collections.abc import Mapping
from pathlib import Path

from ...common.atomic import whole_file

EPOCH = (1980, 1, 1, 0, 0, 0)  # earliest date of a zip file


def write_zip(path: Path, files: Mapping[str, bytes]) -> None:
    """Write ``files`` (name in the archive -> content) in name order, with fixed dates and modes.

    The archive is written atomically.
    """
    with whole_file(path) as partial, zipfile.ZipFile(partial, "w") as archive:
        for name in sorted(files):
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, files[name], compresslevel=6)


def read_zip(path: Path) -> dict[str, bytes]:
    """Return all files of an archive by name."""
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}


def content_guid(files: dict[str, bytes]) -> str:
    """Return the GUID of an FMU: a hash of its files, including modelDescription.xml without the GUID."""
    digest = hashlib.sha256()
    for name in sorted(files):
        digest.update(name.encode() + b"\0" + hashlib.sha256(files[name]).digest())
    text = digest.hexdigest()
    return f"{{{text[:8]}-{text[8:12]}-{text[12:16]}-{text[16:20]}-{text[20:32]}}}"
