"""Composed files on disk: an SSD that says what it was written from, and is not written over once it was edited."""

from __future__ import annotations

import hashlib
import os
import re
from pathlib import Path

from ..common.atomic import write_atomically
from ..common.bounds import XML_BYTES
from ..common.errors import InputError
from ..common.regular import read_input
from .source import ANNOTATIONS_FILE, SystemSource
from .text import write_toml

MARK = re.compile(
    rb"<!-- Written by perilune compose from [^\n]*, SHA-256 [0-9a-f]{64}: change that file\."
    rb" SHA-256 of what follows: ([0-9a-f]{64}) -->\n"
)


def add_mark(document: bytes, file: str, raw: bytes) -> bytes:
    """Return an SSD with a comment behind its first line: its source, the digests of that and of the SSD."""
    declaration, _, body = document.partition(b"\n")
    name = file.replace("--", "- -").encode()
    digests = [hashlib.sha256(each).hexdigest().encode() for each in (raw, body)]
    mark = b"<!-- Written by perilune compose from %s, SHA-256 %s: change that file." % (name, digests[0])
    return b"%s\n%s SHA-256 of what follows: %s -->\n%s" % (declaration, mark, digests[1], body)


def check_unedited(path: Path, option: str = "") -> None:
    """Refuse to write over an SSD that `add_mark` did not mark, or that was edited since. Raises InputError."""
    if not os.path.lexists(path):
        return
    content = read_input(path, "move it away", XML_BYTES)
    match = MARK.search(content)
    if match is None:
        remedy = f"move it away; perilune compose {path.parent} --output FILE.toml writes what it says as a system.toml"
        raise InputError(path, option, "was not written by perilune compose, and is not written over", remedy)
    if hashlib.sha256(content[match.end() :]).hexdigest().encode() != match[1]:
        problem = "was edited since perilune compose wrote it, and is not written over"
        raise InputError(path, option, problem, "bring the change into the system.toml and move the file away")


def write_source(source: SystemSource, path: Path) -> list[Path]:
    """Write a `system.toml`, its annotations beside it, neither over other content; return the paths.

    Raises InputError and OSError.
    """
    contents = {path: write_toml(source).encode()}
    if source.annotations:
        contents[path.with_name(ANNOTATIONS_FILE)] = source.annotations
    for each, content in contents.items():
        if os.path.lexists(each) and read_input(each, "move it away", XML_BYTES) != content:
            raise InputError("`output`", str(each), "exists already and is not written over", "move it away")
    for each, content in contents.items():
        write_atomically(each, content)
    return list(contents)
