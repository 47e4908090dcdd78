"""Simulation in a second thread, so that the caller's thread can react to Ctrl-C and to timeouts."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import replace
from functools import partial
from typing import TypeVar

import numpy as np

from ..ssp.parameter_values import ParameterValue
from ..system.prepared import PreparedSystem
from .base_simulation import BaseSimulation
from .recorder import FlightRecorder
from .results import HUNG, TIMED_OUT, Flight, FlightResult

T = TypeVar("T")
Flown = TypeVar("Flown", bound=Flight)
PATIENCE = 1.5  # s, time for a flight to reach its next communication point


class StuckError(TimeoutError):
    """FMU whose step does not return: its thread and instances are lost. The message states the time of the step."""


def fly(simulation: BaseSimulation, timeout: float | None = None) -> FlightResult:
    """Simulate once. Ctrl-C and ``timeout`` (s of wall time) end the simulation at its next communication point.

    The rows recorded so far are returned with the status ``interrupted`` or ``timed_out``. Raises KeyboardInterrupt or
    StuckError if no communication point is reached within PATIENCE, since the step of an FMU cannot be interrupted.
    """
    work = partial(_within, simulation, timeout, simulation.fly)
    return wait(work, simulation.interrupt, partial(simulation.abort, "was interrupted"))


def run(simulation: BaseSimulation, values: Mapping[str, ParameterValue], timeout: float | None = None) -> Flight:
    """Simulate one trial with a timeout as in `fly`, in a thread that does not receive Ctrl-C."""
    return _within(simulation, timeout, partial(simulation.run, values))


def make_empty_flight(simulation: BaseSimulation, message: str) -> Flight:
    """Return a flight without rows, for a simulation that lost its rows because a step did not return."""
    nothing = np.empty(0)
    types = {name: simulation.layout.types[name] for name in simulation.signal_names}
    return Flight(nothing, dict.fromkeys(types, nothing), types, HUNG, message)


def _within(simulation: BaseSimulation, timeout: float | None, work: Callable[[], Flown]) -> Flown:
    """Return the flight simulated by ``work``, which is interrupted after ``timeout`` seconds of wall time."""
    if timeout is None:
        return work()
    future = _start(work)
    try:
        return future.result(timeout=timeout)
    except TimeoutError:
        simulation.interrupt()
    try:
        flight = future.result(timeout=PATIENCE)
    except TimeoutError:
        late = f"did not return {PATIENCE:g} s after its time limit of {timeout:g} s"
        if not simulation.abort(late):
            where = progress_text(simulation.prepared, simulation.recorder)
            raise StuckError(f"an FMU {late}, {where}") from None
        flight = future.result()
    simulation.interrupt(False)  # otherwise the next flight would end at once
    if flight.status != "interrupted":
        return flight  # it reached its last point in the meantime
    message = f"took longer than its time limit of {timeout:g} s: ended at t = {_point(simulation):g} s"
    return replace(flight, status=TIMED_OUT, message=message)


def _point(simulation: BaseSimulation) -> float:
    """Return the time (s) of the communication point being computed, or of the last one."""
    return simulation.prepared.start + simulation.recorder.point * simulation.prepared.step


def progress_text(prepared: PreparedSystem, recorder: FlightRecorder) -> str:
    """Return progress as text: the communication point being computed, and the component that stepped last."""
    if not recorder.point:
        return "in the initialisation"
    time = prepared.start + recorder.point * prepared.step
    return f"on the way to t = {time:g} s, the last to step was {list(prepared.network.fmus)[recorder.subject]}"


def wait(work: Callable[[], T], interrupt: Callable[[], None], abort: Callable[[], object]) -> T:
    """Return the result of ``work``, executed in a thread; on Ctrl-C interrupt it, and give up after PATIENCE.

    Outside the main thread, which alone receives Ctrl-C, ``work`` is executed directly.
    """
    if threading.current_thread() is not threading.main_thread():
        return work()
    future: Future[T] = Future()
    try:  # Ctrl-C may occur before `start` returns, while the thread already runs
        _start_into(work, future)
        return future.result()
    except KeyboardInterrupt:
        interrupt()
        try:
            return future.result(timeout=PATIENCE)
        except TimeoutError:
            abort()
            raise KeyboardInterrupt from None


def _start(work: Callable[[], T]) -> Future[T]:
    future: Future[T] = Future()
    _start_into(work, future)
    return future


def _start_into(work: Callable[[], T], future: Future[T]) -> None:
    """Execute ``work`` in a daemon thread, which does not keep the process alive; set its result in ``future``."""

    def run() -> None:
        try:
            future.set_result(work())
        except BaseException as error:  # any exception is raised again by the waiting thread
            future.set_exception(error)

    threading.Thread(target=run, daemon=True).start()
