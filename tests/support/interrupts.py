"""Signals at a chosen moment, also if a background shell ignores SIGINT, and the processes started by a command."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

import psutil

PATIENCE = 60.0  # s, in which a command has started what it needs


@contextmanager
def interrupted_when(condition):
    """Raise KeyboardInterrupt in the main thread as soon as ``condition()`` is true in another."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    over = threading.Event()

    def watch():
        while not condition() and not over.is_set():
            time.sleep(0.002)
        if not over.is_set():
            os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=watch, daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()
        signal.signal(signal.SIGINT, before)


@contextmanager
def started(
    words: Sequence[str], folder: Path, environment: Mapping[str, str] | None = None, module: str = "perilune"
) -> Iterator[subprocess.Popen[bytes]]:
    """Yield a command that runs in a folder, and kill it in the end."""
    with (folder / "errors").open("wb") as errors:
        command = subprocess.Popen(
            [sys.executable, "-m", module, *words],
            cwd=folder,
            env={**os.environ, **(environment or {})},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=errors,
            preexec_fn=_heed_signals,
        )
        try:
            yield command
        finally:
            command.kill()
            command.wait()


def _heed_signals() -> None:
    """Undo what runs the tests in the background: a shell hands SIGINT down as ignored, nohup SIGHUP."""
    for each in (signal.SIGINT, signal.SIGHUP):
        signal.signal(each, signal.SIG_DFL)


def descendants(command: subprocess.Popen[bytes]) -> list[psutil.Process]:
    """Return the processes that a command has started, and those that these have."""
    with suppress(psutil.NoSuchProcess):
        return psutil.Process(command.pid).children(recursive=True)
    return []


def wait_for(command: subprocess.Popen[bytes], is_enough: Callable[[list[str]], bool]) -> list[psutil.Process]:
    """Return the descendants of a command, once their command lines are enough."""
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline and command.poll() is None:
        family = descendants(command)
        lines = []
        for each in family:
            with suppress(psutil.Error):
                lines.append(" ".join(each.cmdline()))
        if is_enough(lines):
            return family
        time.sleep(0.02)
    raise AssertionError(f"ended with {command.poll()}, or it has started nothing")


def seconds_until_gone(family: Sequence[psutil.Process], limit: float) -> tuple[float, list[str]]:
    """Return the time (s) until all have ended, and the command lines of those that have not within a limit."""
    begun = time.monotonic()
    while (alive := list(filter(None, map(_line, family)))) and time.monotonic() < begun + limit:
        time.sleep(0.02)
    return time.monotonic() - begun, alive


def _line(process: psutil.Process) -> str:
    """Return the command line of a process; empty where it has ended, though its new parent may not have asked how."""
    with suppress(psutil.Error):
        return "" if process.status() == psutil.STATUS_ZOMBIE else " ".join(process.cmdline())
    return ""
