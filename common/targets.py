"""Output files and folders of a command: checked before any simulation, written one by one at the end."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Callable, Collection
from pathlib import Path

from .atomic import PARTIAL
from .errors import InputError
from .machine.os_errors import line_of

DEVICES = Path("/dev")  # its links, such as /dev/stdout, may lead to ordinary files
LONGEST_NAME = 255  # bytes, on all common file systems
PAGES = (".html", ".htm")
RESULTS = (
    "manifest.json", "trials", "draws.parquet", "summary.json", "checkpoint.json", "pareto.json", "law.json",
    "rare.json", "worst.json", "sensitivity.json", "flights.parquet", "failures.parquet", "worst.parquet",
)  # fmt: skip


def check_encoding(option: str, name: str) -> None:
    """Reject a name that is not UTF-8, since Arrow and libxml2 cannot open such files. Raises InputError."""
    try:
        name.encode()
    except UnicodeEncodeError:
        raise InputError(option, name, "not UTF-8", "give a path in UTF-8") from None


def check_file(option: str, path: Path | None, suffixes: Collection[str] = (), new_folders: int = 1) -> None:
    """Check before any simulation, by opening the file, that it can be written. Raises InputError.

    At most ``new_folders`` folders may be missing and will be created when the file is written, but none in the root.
    """
    if path is None:
        return
    check_encoding(option, str(path.absolute()))
    if os.path.isdir(path):
        ending = f", ending with {' or '.join(suffixes)}" if suffixes else ""
        raise InputError(option, str(path), "is a folder", f"give the name of a file in it{ending}")
    if suffixes and path.suffix not in suffixes:
        problem = f"{'neither' if len(suffixes) > 1 else 'not'} {' nor '.join(suffixes)}"
        raise InputError(option, str(path), problem, f"end the name with {' or '.join(suffixes)}")
    is_device_link = os.path.islink(path) and path.absolute().parent.resolve() == DEVICES
    if is_device_link or (os.path.exists(path) and not os.path.isfile(path)):
        raise InputError(option, str(path), "is a device, not a regular file", "give the name of a file")
    _check_folder(option, path, path.parent, new_folders)
    if os.path.exists(path):
        try:
            path.open("ab").close()
        except OSError as error:
            problem = f"cannot be written: {error.strerror}"
            raise InputError(option, str(path), problem, "give another file, or change its permissions") from error


def check_folder(option: str, path: Path | None, *, overwrite: bool, otherwise: str = "`overwrite`") -> None:
    """Reject a folder that cannot be written, or that contains results unless ``overwrite``. Raises InputError.

    The folder and its parent may be missing, but no new folder may be in the root. ``otherwise`` names the option that
    permits a folder with results.
    """
    if path is None:
        return
    check_encoding(option, str(path.absolute()))
    _check_folder(option, path, path, 2)
    held = [name for name in RESULTS if os.path.exists(path / name)]
    if held and not overwrite:
        problem = f"holds results already ({', '.join(held)})"
        raise InputError(option, str(path), problem, f"give another folder, or {otherwise}")


def _check_folder(option: str, path: Path, folder: Path, new_folders: int) -> None:
    """Reject a file in ``folder``, or the folder itself, that cannot be written; test in the nearest existing
    folder.
    """
    here = folder.absolute()
    folders = [here, *here.parents]
    nearest = next(place for place in folders if os.path.exists(place))
    missing = folders[: folders.index(nearest)]
    if not os.path.isdir(nearest):
        raise InputError(option, str(path), f"{nearest} is a file", "give another folder")
    if missing and nearest == nearest.parent:
        remedy = f"create it first (mkdir {missing[-1]}), or omit the leading {nearest}"
        raise InputError(option, str(path), f"{missing[-1]} would be a new folder in the root", remedy)
    if len(missing) > new_folders:
        remedy = f"create it first (mkdir -p {missing[new_folders]}), or correct the path"
        raise InputError(option, str(path), f"there is no folder {missing[-1]}", remedy)
    name = "results" if path == folder else path.name
    try:
        if any(len(os.fsencode(place.name)) > LONGEST_NAME for place in missing):
            raise OSError(errno.ENAMETOOLONG, os.strerror(errno.ENAMETOOLONG))
        probe = nearest / f".{name}.{os.getpid()}{PARTIAL}"
        try:
            probe.open("wb").close()
        finally:
            probe.unlink(missing_ok=True)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(option, str(path), f"cannot be written in {nearest}: {reason}", "give another path") from error


class Results:
    """Output of a command; failure to write one file does not prevent the others.

    A command creates its instance before it loads an FMU, since an FMU may change the process's working folder, to
    which paths are relative.
    """

    def __init__(self) -> None:
        self.home = Path.cwd()
        self.written: list[Path] = []
        self.failed = False

    def write(self, path: Path | None, write: Callable[[Path], object]) -> None:
        """Write one file or folder if it is requested."""
        if path is None:
            return
        try:
            write(self.home / path)
        except OSError as error:
            self.failed = True
            print(f"perilune: {line_of(error, path)}", file=sys.stderr)
        else:
            self.written.append(path)

    def print_paths(self) -> None:
        """Print the paths of the written files."""
        if self.written:
            print(f"written: {', '.join(map(str, self.written))}")
