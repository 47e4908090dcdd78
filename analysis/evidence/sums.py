"""Check of an archive against its SHA256SUMS: every file must be unchanged since the archive was written."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping

from ...common.errors import InputError
from ...fmus_src.evidence.manifest import NOT_LISTED, SUMS

LENGTH = 64  # hexadecimal digits
SEPARATORS = ("  ", " *")  # in text mode, and in binary mode


def check_sums(files: Mapping[str, bytes], label: str) -> tuple[dict[str, str], list[str]]:
    """Return a problem, by file name, for each missing or changed file, and the names of files that were added later.

    Both are empty if there is no SHA256SUMS. Raises InputError for a line that is not in the format of sha256sum.
    """
    if SUMS not in files:
        return {}, []
    listed: dict[str, str] = {}
    for number, line in enumerate(files[SUMS].decode("utf-8", "replace").removesuffix("\n").split("\n"), start=1):
        if not line:
            continue
        digest, separator, name = line[:LENGTH], line[LENGTH : LENGTH + 2], line[LENGTH + 2 :].removesuffix("\r")
        if separator not in SEPARATORS or not name or not set(digest) <= set("0123456789abcdef"):
            raise InputError(
                f"{label}!{SUMS}", f"line {number}", "not in the format of sha256sum", "export the file again"
            )
        listed[name] = digest
    problems = {}
    for name, digest in listed.items():
        if name not in files:
            problems[name] = "missing, though SHA256SUMS lists it"
        elif hashlib.sha256(files[name]).hexdigest() != digest:
            problems[name] = "changed: its SHA-256 differs from SHA256SUMS"
    return problems, [name for name in files if name not in listed and name not in NOT_LISTED]
