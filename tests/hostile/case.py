"""A hostile input: how it is written, the commands that read it, and the line that refuses it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

Write = Callable[[Path, Path], object]  # into the working folder; the second has good FMUs


@dataclass(frozen=True)
class Case:
    """``write`` puts the files into the working folder, which ``commands`` read, each without the name `perilune`.

    All of them end with ``status`` and one line with all ``words``, file and element among them. Those that are
    ``accepted`` may print what they read: without control characters.
    """

    write: Write
    commands: tuple[str, ...]
    words: tuple[str, ...] = ()
    status: int = 2
    accepted: bool = False


Content = str | bytes | Callable[[], str | bytes]  # large content is computed when it is written


def put(name: str, content: Content) -> Write:
    """Return a writer of one file of this content."""

    def write(folder: Path, _: Path) -> None:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        text = content() if callable(content) else content
        path.write_bytes(text.encode() if isinstance(text, str) else text)

    return write
