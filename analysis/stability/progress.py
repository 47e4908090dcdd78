"""Progress of a study: counted in steps, of this process and others, and shown on a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing.connection import Connection
from threading import Thread

from loky.backend import get_context

from ...common.progress import progress_bar

Tell = Callable[[int, int], None]  # numbers of added and of completed steps

_pipe: Connection | None = None  # pipe of a worker process


@contextmanager
def show_progress() -> Iterator[Tell]:
    """Yield a progress bar on standard error during a study, if that is a terminal."""
    with progress_bar(total=0, unit="step") as bar:

        def update(expected: int, done: int) -> None:
            bar.total += expected
            bar.update(done)

        yield update


@contextmanager
def listen(tell: Tell) -> Iterator[Connection]:
    """Yield a pipe for the steps of worker processes, each of which calls `begin` with it and exits within the block.

    The pipe has no lock, which a killed worker would not release; writes of a few bytes are atomic.
    """
    reader, writer = get_context("loky").Pipe(duplex=False)

    def listen() -> None:
        with reader:
            while (steps := reader.recv()) is not None:
                tell(*steps)

    listener = Thread(target=listen, daemon=True)
    listener.start()
    try:
        yield writer
    finally:
        writer.send(None)  # not the end of the pipe, which a worker that still exists would delay
        listener.join()
        writer.close()


def begin(pipe: Connection) -> None:
    """Send all further steps of this worker process through a pipe."""
    global _pipe
    _pipe = pipe


def tell_parent(expected: int, done: int) -> None:
    assert _pipe is not None  # set by `begin`
    _pipe.send((expected, done))
