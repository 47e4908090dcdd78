"""Flights off the main thread, which stays free to hear Ctrl-C."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import Future
from typing import TypeVar

from .results import Result
from .simulation import Simulation

Found = TypeVar("Found")
PATIENCE = 1.5  # s that a flight has to reach its next communication point


def fly(simulation: Simulation) -> Result:
    """One flight. Ctrl-C ends it at its next communication point: what was flown comes back, ``interrupted``.

    Raises KeyboardInterrupt where no point is reached within PATIENCE: a step of an FMU cannot be cut.
    """
    return wait(simulation.fly, simulation.interrupt)


def wait(work: Callable[[], Found], interrupt: Callable[[], None]) -> Found:
    """What ``work`` gives, done in a thread; Ctrl-C calls ``interrupt`` and waits a while for the rest.

    Elsewhere than in the main thread, which alone hears of it, the work is done at once.
    """
    if threading.current_thread() is not threading.main_thread():
        return work()
    future: Future[Found] = Future()

    def run() -> None:
        try:
            future.set_result(work())
        except BaseException as error:  # whatever it is, it is raised where the work is waited for
            future.set_exception(error)

    try:  # Ctrl-C may come as soon as the thread runs, before its start returns
        threading.Thread(target=run, daemon=True).start()
        return future.result()
    except KeyboardInterrupt:
        interrupt()
        try:
            return future.result(timeout=PATIENCE)
        except TimeoutError:
            raise KeyboardInterrupt from None
