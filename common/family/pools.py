"""Pools of worker processes (loky) that end with this process, and immediately if an exception ends its work."""

from __future__ import annotations

import atexit
import os
import pickle
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

from loky import ProcessPoolExecutor
from loky.backend.reduction import dumps
from loky.backend.utils import kill_process_tree

from ..process import exit_process
from .ending import end_with_parent


@contextmanager
def process_pool(count: int, begin: Callable[..., object], *arguments: Any) -> Iterator[ProcessPoolExecutor]:
    """Open a pool of ``count`` processes for the thread that calls this function; each process first calls ``begin``.

    An exception in the block, including Ctrl-C, kills the processes, since their current work may take long.
    """
    work = _Packed(partial(begin, *arguments))
    pool = ProcessPoolExecutor(count, initializer=_begin, initargs=(os.getpid(), work))
    try:
        yield pool
    except BaseException:
        # The pool kills them by a thread, which Ctrl-C can forestall while processes start.
        for worker in list(pool._processes.values()):
            kill_process_tree(worker)
        pool.shutdown(kill_workers=True)
        raise
    pool.shutdown()


class _Packed:
    """Content that a worker process unpickles only after its start, since this may take seconds."""

    def __init__(self, content: Any) -> None:
        self._content = content

    def __getstate__(self) -> bytes:
        return bytes(dumps(self._content))

    def __setstate__(self, pickled: bytes) -> None:
        self._content = pickled

    def unpack(self) -> Any:
        """Return the content; called in the receiving process."""
        return pickle.loads(self._content)


def _begin(parent: int, work: _Packed) -> None:
    end_with_parent(parent)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a terminal sends it to all processes; the parent decides
    atexit.register(exit_process, 0)  # registered first, so that it runs last
    work.unpack()()
