"""Where a command's results go: looked at before anything flies, written each for itself at the end."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Collection
from pathlib import Path

from .errors import InputError

PAGES = (".html", ".htm")
RESULTS = (
    "manifest.json", "trials", "draws.parquet", "summary.json", "checkpoint.json", "pareto.json", "law.json",
    "rare.json", "worst.json", "sensitivity.json", "flights.parquet", "failures.parquet", "worst.parquet",
)  # fmt: skip


def check_file(option: str, path: Path | None, suffixes: Collection[str] = ()) -> None:
    """Refuse a file that cannot be written, before anything flies. Raises InputError."""
    if path is None:
        return
    if path.is_dir():
        ending = f", ending with {' or '.join(suffixes)}" if suffixes else ""
        raise InputError(option, str(path), "is a folder", f"give the name of a file in it{ending}")
    if suffixes and path.suffix not in suffixes:
        problem = f"{'neither' if len(suffixes) > 1 else 'not'} {' nor '.join(suffixes)}"
        raise InputError(option, str(path), problem, f"end the name with {' or '.join(suffixes)}")
    _check_folder(option, path.parent)
    if path.exists() and not os.access(path, os.W_OK):
        raise InputError(option, str(path), "cannot be written", "give another file, or change its permissions")


def check_folder(option: str, path: Path | None, *, overwrite: bool, otherwise: str = "--overwrite") -> None:
    """Refuse a folder that cannot be written, or that holds results unless ``overwrite``. Raises InputError.

    ``otherwise`` is the option with which it would not be refused.
    """
    if path is None:
        return
    _check_folder(option, path)
    held = [name for name in RESULTS if (path / name).exists()]
    if held and not overwrite:
        problem = f"holds results already ({', '.join(held)})"
        raise InputError(option, str(path), problem, f"give another, or {otherwise}")


def _check_folder(option: str, folder: Path) -> None:
    """A folder that is there and can be written to, or that can be made."""
    nearest = next(place for place in (folder, *folder.absolute().parents) if place.exists())
    if not nearest.is_dir():
        raise InputError(option, str(folder), f"{nearest} is a file", "give another folder")
    if not os.access(nearest, os.W_OK | os.X_OK):
        raise InputError(option, str(folder), f"{nearest} cannot be written to", "give another folder")


class Results:
    """What a command writes: one that cannot be written keeps no other from it.

    Made before an FMU is loaded, since one may change the process's working folder, from which relative paths are
    meant.
    """

    def __init__(self) -> None:
        self.home = Path.cwd()
        self.written: list[Path] = []
        self.failed = False

    def write(self, path: Path | None, write: Callable[[Path], object]) -> None:
        """Write one file or folder, if it is asked for."""
        if path is None:
            return
        try:
            write(self.home / path)
        except OSError as error:
            self.failed = True
            name = error.filename or path
            print(f"perilune: {name}: {error.strerror or error}; give another path or make room", file=sys.stderr)
        else:
            self.written.append(path)

    def say(self) -> None:
        """Where the files are, on the terminal."""
        if self.written:
            print(f"written: {', '.join(map(str, self.written))}")
