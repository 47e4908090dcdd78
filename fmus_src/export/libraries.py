"""Shared libraries from C sources, cached by content."""

from __future__ import annotations

import hashlib
import signal
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from pathlib import Path

from ...common.family.programs import Ended, run_program
from ...common.machine.cached import cached_file
from .compilers import FLAGS, FOR_THIS_PROCESSOR, PLATFORMS, CompilationFailed, compilers_for
from .fat_binary import fat_binary


@cache
def _identity(command: tuple[str, ...]) -> str:
    """Return the command and the version of a compiler, for the cache key."""
    with tempfile.TemporaryDirectory() as folder:  # zig leaves a file in its working folder
        version = _output([*command, "--version"], folder)
    return " ".join(command[1:] if command[0] == sys.executable else command) + version


@cache
def _processor(command: tuple[str, ...]) -> str:
    """Return the compiler's name of this processor, for the key of a cache that machines may share."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "empty.c").touch()
        return _output([*command, FOR_THIS_PROCESSOR, "-dM", "-E", "empty.c"], folder)


def _output(command: list[str], folder: str) -> str:
    return _run(command, folder).output


def _run(command: list[str], folder: str | Path, is_needed: Callable[[], bool] = lambda: True) -> Ended:
    """Run a compiler. Raises `CompilationFailed` if it fails, does not start, or is no longer needed."""
    try:
        ended = run_program(command, folder, is_needed)
    except OSError as error:
        raise CompilationFailed(f"{command[0]} cannot be run: {error.strerror}") from error
    if ended is None:
        raise CompilationFailed("ended, since its result is no longer needed")
    return ended


def build_library(
    sources: Mapping[str, bytes], main: str, platform: str, cache: Path, *, portable: bool = False
) -> bytes:
    """Build the shared library of ``main`` like `library_files`, as one file also for several processors."""
    libraries = [path.read_bytes() for path in library_files(sources, main, platform, cache, portable=portable)]
    return libraries[0] if len(libraries) == 1 else fat_binary(libraries)


def library_files(
    sources: Mapping[str, bytes],
    main: str,
    platform: str,
    cache: Path,
    *,
    portable: bool = False,
    flags: Sequence[str] = FLAGS,
    is_needed: Callable[[], bool] = lambda: True,
) -> list[Path]:
    """Build the shared library of the source file ``main`` in ``cache`` for each processor of a platform.

    ``sources`` contains all files by name, ``flags`` the compiler flags. The libraries depend only on sources, flags
    and compiler, not on time or folder. A damaged library in the cache is compiled again; a temporary file is used if
    the cache cannot be written. The compiler is terminated when ``is_needed`` returns False. Raises `CompilerMissing`,
    `CompilationFailed`, and OSError if no file can be written.
    """
    commands = compilers_for(platform, portable)
    extension = PLATFORMS[platform].extension
    files = []
    for command in commands:
        identity = _identity(tuple(command)) + (_processor(tuple(command)) if FOR_THIS_PROCESSOR in flags else "")
        digest = hashlib.sha256("\0".join([identity, *flags, main]).encode())
        for name in sorted(sources):
            digest.update(b"\0" + name.encode() + b"\0" + hashlib.sha256(sources[name]).digest())
        library = partial(_compile, [*command, *flags], sources, main, Path(main).stem + extension, is_needed)
        files.append(cached_file(cache / f"{digest.hexdigest()[:32]}{extension}", library))
    return files


def _compile(
    command: list[str], sources: Mapping[str, bytes], main: str, output: str, is_needed: Callable[[], bool]
) -> bytes:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for source, text in sources.items():
            (folder / source).write_bytes(text)
        about = f"{' '.join(command)} on {main}"
        status, _, message = _run([*command, "-o", output, main, "-lm"], folder, is_needed)
        if status != 0:
            end = f"ended by {signal.Signals(-status).name}" if status < 0 else f"ended with status {status}"
            raise CompilationFailed(f"{about}:\n{message or f'error: it {end} without a message'}")
        library = folder / output
        if not library.is_file() or not library.stat().st_size:
            raise CompilationFailed(f"{about}:\nerror: the compiler wrote no library")
        return library.read_bytes()
