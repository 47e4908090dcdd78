"""SHA256SUMS in an archive's evidence: every file is what it was when the archive was written."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping

from ...fmus_src.evidence.manifest import NOT_LISTED, SUMS
from ..common.errors import InputError

LENGTH = 64  # hexadecimal digits


def check_sums(files: Mapping[str, bytes], label: str) -> tuple[list[str], list[str]]:
    """Problems, files that are missing or changed, and notes on files that were added; nothing without SHA256SUMS.

    Raises InputError for a SHA256SUMS that is none.
    """
    if SUMS not in files:
        return [], []
    listed: dict[str, str] = {}
    for number, line in enumerate(files[SUMS].decode("utf-8", "replace").splitlines(), start=1):
        digest, separator, name = line[:LENGTH], line[LENGTH : LENGTH + 2], line[LENGTH + 2 :]
        if separator != "  " or not name or not set(digest) <= set("0123456789abcdef"):
            raise InputError(f"{label}!{SUMS}", f"line {number}", "not as sha256sum writes it", "export the file again")
        listed[name] = digest
    problems = []
    for name, digest in listed.items():
        if name not in files:
            problems.append(f"{name}: missing, though SHA256SUMS lists it")
        elif hashlib.sha256(files[name]).hexdigest() != digest:
            problems.append(f"{name}: changed: its SHA-256 is not that of SHA256SUMS")
    added = [name for name in files if name not in listed and name not in NOT_LISTED]
    return problems, [f"{name}: not in SHA256SUMS, added later" for name in added]
