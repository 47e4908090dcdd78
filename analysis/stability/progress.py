"""How far a study is: counted in its steps, by this process and others, and shown on a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Thread

from loky.backend import get_context
from loky.backend.queues import SimpleQueue

from ..common.process import leave_when_done
from ..common.progress import progress_bar

Tell = Callable[[int, int], None]  # so many more steps are to be done, so many more are done

_queue: SimpleQueue | None = None  # of a worker process


@contextmanager
def show_progress() -> Iterator[Tell]:
    """A bar on standard error while a study goes on, if that is a terminal."""
    with progress_bar(total=0, unit="step") as bar:

        def tell(expected: int, done: int) -> None:
            bar.total += expected
            bar.update(done)

        yield tell


@contextmanager
def listen(tell: Tell) -> Iterator[SimpleQueue]:
    """A queue for worker processes, whose steps are told on; each starts with `begin` and it."""
    queue = SimpleQueue(ctx=get_context("loky"))

    def listen() -> None:
        while (steps := queue.get()) is not None:
            tell(*steps)

    listener = Thread(target=listen, daemon=True)
    listener.start()
    try:
        yield queue
    finally:
        queue.put(None)
        listener.join()


def begin(queue: SimpleQueue) -> None:
    """The first thing that a worker process does."""
    global _queue
    leave_when_done()
    _queue = queue


def tell_parent(expected: int, done: int) -> None:
    assert _queue is not None  # the process has begun with it
    _queue.put((expected, done))
