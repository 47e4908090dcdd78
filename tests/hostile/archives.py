"""Zip archives that are bombs, lie about their entries, or would write elsewhere."""

from __future__ import annotations

import io
import struct
import warnings
import zipfile
from pathlib import Path

from tests.support.builders import document, system
from tests.support.refused import RAMP

from .case import Case, Content, put

SSD = document(system(RAMP))
LOCAL, CENTRAL, END = b"PK\3\4", b"PK\1\2", b"PK\5\6"


def zipped(*entries: tuple[str | zipfile.ZipInfo, bytes | str], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    """Return an archive of a description and these entries, which may have one name."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", method) as archive, warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        for name, text in entries:
            archive.writestr(name, text)
        archive.writestr("SystemStructure.ssd", SSD)
    return content.getvalue()


def bomb(size: int) -> bytes:
    """Return an archive of zeros, ``size`` bytes unpacked."""
    content = io.BytesIO()
    with (
        zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive,
        archive.open("SystemStructure.ssd", "w", force_zip64=True) as file,
    ):
        for _ in range(size // 1_000_000):
            file.write(bytes(1_000_000))
    return content.getvalue()


def link() -> bytes:
    """Return an entry that Unix tools unpack as a link to a file of the machine."""
    entry = zipfile.ZipInfo("SystemStructure.ssd")
    entry.external_attr = 0o120777 << 16
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        archive.writestr(entry, "/etc/passwd")
    return content.getvalue()


def patched(content: bytes, position: int, number: int, form: str, *, signature: bytes = CENTRAL) -> bytes:
    """Return an archive with another number in the last of its headers of this signature."""
    changed = bytearray(content)
    struct.pack_into(form, changed, changed.rindex(signature) + position, number)
    return bytes(changed)


def many(number: int) -> bytes:
    """Return an archive with ``number`` empty files."""
    return zipped(*((f"resources/{each}", b"") for each in range(number)), method=zipfile.ZIP_STORED)


PLAIN = zipped(("resources/a.ssv", b"x" * 1000))


def encrypted() -> bytes:
    changed = patched(PLAIN, 8, 1, "<H")
    return patched(changed, 6, 1, "<H", signature=LOCAL)


def overlapping() -> bytes:
    """Return two entries of the directory with one content."""
    archive = zipped(("resources/a", b"x" * 1000), ("resources/b", b"x" * 1000))
    second = archive.rindex(CENTRAL)
    first = archive.rindex(CENTRAL, 0, second)
    (offset,) = struct.unpack_from("<I", archive, first + 42)
    return patched(archive, 42, offset, "<I")


def wrong_size(folder: Path, _: Path) -> None:
    with (folder / "hostile.ssp").open("wb") as file:
        file.truncate(3_000_000_000)  # sparse


ARCHIVES: dict[str, tuple[Content, tuple[str, ...]]] = {
    "empty": (b"", ("not a readable zip",)),
    "no zip": (b"\x1b[31mPK" * 99, ("not a readable zip",)),
    "truncated": (PLAIN[: len(PLAIN) // 2], ("not a readable zip",)),
    "an end alone": (END + bytes(18), ("SystemStructure.ssd", "not found")),
    "a parent's entry": (zipped(("../outside", b"x")), ("../outside", "leads out of the archive")),
    "a parent's entry inside": (zipped(("resources/../../x", b"x")), ("resources/../../x", "leaves")),
    "an absolute entry": (zipped(("/tmp/outside", b"x")), ("/tmp/outside", "leaves")),
    "a drive's entry": (zipped(("C:/outside", b"x")), ("C:/outside", "leaves")),
    "a backslash": (zipped(("..\\outside", b"x")), ("..\\outside", "a backslash")),
    "a link for a description": (link(), ("SystemStructure.ssd", "a symbolic link", "not accepted in an archive")),
    "two descriptions": (zipped(("SystemStructure.ssd", b"<x/>")), ("SystemStructure.ssd", "two files have this name")),
    "a folder and a file of one name": (
        zipped(("resources/ramp.fmu/x", b""), ("resources/ramp.fmu", b"")),
        ("ramp.fmu",),
    ),
    "10^5 entries": (lambda: many(100_000), ("files, at most 10000",)),
    "a declared size of 4 GB": (patched(PLAIN, 24, 0xFFFFFFF0, "<I"), ("4.29497e+09 bytes, at most 2e+09",)),
    "a size that is less": (patched(PLAIN, 24, 10, "<I"), ("SystemStructure.ssd", "damaged")),
    "another checksum": (patched(PLAIN, 16, 1, "<I"), ("SystemStructure.ssd", "damaged")),
    "encrypted": (encrypted(), ("SystemStructure.ssd", "encrypted")),
    "an unknown method": (patched(PLAIN, 10, 99, "<H"), ("SystemStructure.ssd", "compression")),
    "a version to come": (patched(PLAIN, 6, 999, "<H"), ("not a readable zip",)),
    "an offset behind the end": (patched(PLAIN, 42, 2**31, "<I"), ("SystemStructure.ssd", "damaged")),
    "overlapping entries": (overlapping(), ("zip",)),
    "a directory elsewhere": (patched(PLAIN, 16, 2**31, "<I", signature=END), ("zip",)),
    "escapes in a name": (zipped(("../\x1b[2J\u202egnp.exe", b"")), (r"\x1b[2J\u202e", "leaves")),
    "a line feed in a name": (zipped(("../a\nperilune: all is well", b"")), ("leaves",)),
}
COMMANDS = ("run hostile.ssp --output out/flight.csv",)
CASES = {
    f"archive: {name}": Case(put("hostile.ssp", content), COMMANDS, ("hostile.ssp", *words))
    for name, (content, words) in ARCHIVES.items()
}


CASES |= {
    "archive: 300 MB of zeros": Case(
        lambda folder, _: (folder / "hostile.ssp").write_bytes(bomb(300_000_000)),
        COMMANDS,
        ("hostile.ssp", "SystemStructure.ssd", "3e+08 bytes, at most 2.56e+08"),
    ),
    "archive: a file of 3 GB": Case(wrong_size, COMMANDS, ("hostile.ssp", "3e+09 bytes, at most 2e+09")),
}
