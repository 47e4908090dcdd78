"""Files under the names of their contents: their SHA-256, with the suffix that they had."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path

from ....common.atomic import write_atomically
from ....common.errors import InputError

NAMED = re.compile(r"[0-9a-f]{64}(\..*)?")
AGAIN = "copy the campaign's folder again, with all of its files"


def name_of(content: bytes, suffix: str) -> str:
    """The name under which a content is kept."""
    return f"{hashlib.sha256(content).hexdigest()}{suffix}"


def store(folder: Path, contents: dict[str, bytes]) -> None:
    """Write contents by their names, those that are not there yet."""
    for name, content in contents.items():
        if not (folder / name).is_file():
            write_atomically(folder / name, content)


def forget(folder: Path) -> None:
    """Remove the contents that are kept in a folder; what else lies there stays."""
    for path in folder.glob("*"):
        if NAMED.fullmatch(path.name):
            path.unlink()


def store_content(folder: Path, name: str) -> Path:
    """Where a content lies, once it is seen to be the one of that name. Raises InputError."""
    path = folder / name
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(path, "", "not found", AGAIN) from error
    if name_of(content, path.suffix) != name:
        raise InputError(path, "", "its content is not the one that it is named by", AGAIN)
    return path
