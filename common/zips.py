"""Zip archives of unknown origin: the directory is checked at once, each file when it is read."""

from __future__ import annotations

import io
import lzma
import stat
import struct
import zipfile
import zlib
from collections.abc import Iterator, Mapping

from .bounds import ARCHIVE_BYTES, ARCHIVE_ENTRIES, bound_of
from .errors import InputError

END = b"PK\5\6"  # signature of the directory's last record
REMEDY = "build or copy the file again"
BACKSLASH = "repack the archive with / as the path separator"
LINK = "repack the archive with the file or folder in place of the link"
# errors of zipfile and its decompressors for damaged archives and other files
UNREADABLE = (
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    struct.error,
    EOFError,
    OSError,
    NotImplementedError,
    RuntimeError,
    ValueError,
    OverflowError,
)


def open_zip(packed: bytes, label: str) -> zipfile.ZipFile:
    """Open a zip archive without unpacking it. Raises InputError for damaged, unsafe or too large archives."""
    end = packed.rfind(END)
    if end >= 0:  # before zipfile creates an object for every entry; 65535 means at least that many
        ARCHIVE_ENTRIES.check(int.from_bytes(packed[end + 10 : end + 12], "little"), label, "archive")
    try:
        archive = zipfile.ZipFile(io.BytesIO(packed))
    except UNREADABLE as error:
        raise InputError(label, "archive", f"not a readable zip: {error}", REMEDY) from error
    entries = archive.infolist()
    ARCHIVE_ENTRIES.check(len(entries), label, "archive")
    ARCHIVE_BYTES.check(sum(entry.file_size for entry in entries), label, "archive")
    checksums: dict[str, int] = {}
    for entry in entries:
        name, segments = entry.filename, entry.filename.split("/")
        if "\\" in name:
            raise InputError(
                label, name, "the file name contains a backslash, which the zip format does not allow", BACKSLASH
            )
        if name.startswith("/") or ".." in segments or ":" in segments[0]:
            raise InputError(label, name, "the path leads out of the archive", "repack the archive without this file")
        if stat.S_ISLNK(entry.external_attr >> 16):
            raise InputError(label, name, "is a symbolic link, which is not accepted in an archive", LINK)
        if checksums.setdefault(name, entry.CRC) != entry.CRC:
            raise InputError(
                label, name, "two files have this name and different contents", "repack the archive with one of the two"
            )
    return archive


def read_entry(archive: zipfile.ZipFile, name: str, label: str) -> bytes:
    """Return one file of an archive. Raises InputError if it is too large or damaged."""
    bound_of(name).check(archive.getinfo(name).file_size, label, name)
    try:
        return archive.read(name)
    except UNREADABLE as error:
        raise InputError(label, name, f"is damaged in the archive: {error}", REMEDY) from error


class ZippedFiles(Mapping[str, bytes]):
    """Files of an archive by name, each unpacked when it is read."""

    def __init__(self, packed: bytes, label: str) -> None:
        self._packed = packed
        self._label = label
        self._archive = open_zip(packed, label)
        self._names = {name: None for name in self._archive.namelist() if not name.endswith("/")}

    def __getitem__(self, name: str) -> bytes:
        if name not in self._names:
            raise KeyError(name)
        return read_entry(self._archive, name, self._label)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __reduce__(self) -> tuple[type, tuple[bytes, str]]:
        return ZippedFiles, (self._packed, self._label)
