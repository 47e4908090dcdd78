"""Nonlinear elements: describing functions, and predicted and simulated limit cycles."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ....common.errors import InputError
from ...runtime.flight.results import COMPLETE
from ...runtime.process.opening import open_simulation
from ...runtime.system.options import Layer
from ...runtime.system.prepared import PreparedSystem
from ..loops.curves import Response
from ..loops.describing_function import ELEMENTS, amplitude_range, complete_parameters, describing_function
from ..loops.harmonic_balance import predict
from ..loops.oscillation import find_oscillation
from ..request.channels import Channel
from ..request.declaration import NonlinearElement
from ..results.responses import LimitCycle, Nonlinearity
from .bench import StudyError

POINTS = 400
LARGEST_GAIN = 1e3
FEWEST = 100  # least number of communication points of a simulation that could show an oscillation


def element_report(
    element: NonlinearElement,
    channel: Channel,
    unit: str | None,
    response: Response,
    low: float,
    high: float,
    prepare: Callable[[Layer], PreparedSystem],
) -> Nonlinearity:
    """Report the harmonic balance of an element at a cut with the linear remainder of the loop, L = ``response``.

    ``prepare`` returns the system with the layer of the element, in which its limit cycle is simulated: amplitude and
    period are read from the return signal, or from its integral if N is a function of the integral. Raises InputError
    for invalid parameters of the element.
    """
    try:
        parameters = complete_parameters(element.kind, element.parameters)
    except ValueError as error:
        raise InputError(f"loop {channel.loop}", f"element {element.name}", str(error), "correct the SSD") from error
    try:
        balances = predict(response, _lowest(response, low, high), high, element.kind, parameters)
    except ValueError as error:
        raise StudyError(f"{channel.name}: element {element.name}: {error}") from error
    amplitude = np.geomspace(*amplitude_range(element.kind, parameters), POINTS)
    of_integral = ELEMENTS[element.kind].of_integral
    flown = _simulate(prepare(element.layer), channel, of_integral) if element.layer != Layer() else None
    if unit and of_integral:
        unit = f"{unit}.s"
    stable = [balance for balance in balances if balance.stable]
    cycles = []
    for balance in balances:
        simulated = flown if flown and stable and balance == stable[0] else (None, None)
        cycles.append(LimitCycle(balance.amplitude, 2.0 * np.pi / balance.frequency, balance.stable, *simulated))
    note = ELEMENTS[element.kind].note
    if flown is not None and not stable:
        note += f". None is predicted, but the simulation oscillates: {flown[0]:.4g} at a period of {flown[1]:.4g} s"
    gain = describing_function(element.kind, amplitude, parameters)
    return Nonlinearity(element.name, element.kind, parameters, unit, amplitude, gain, tuple(cycles), note)


def _lowest(response: Response, low: float, high: float) -> float:
    """Return the lowest frequency (rad/s) at which limit cycles are sought.

    Below it L is so large that the element hardly moves, and integrators are dominated by noise.
    """
    frequency = np.geomspace(low, high, POINTS)
    below = np.flatnonzero(abs(response(frequency)) < LARGEST_GAIN)
    return float(frequency[below[0]]) if below.size else low


def _simulate(prepared: PreparedSystem, channel: Channel, integrated: bool) -> tuple[float, float] | None:
    """Return amplitude and period (s) of the return signal at the end of a simulation, None without an oscillation.

    If ``integrated``, the signal's integral over time is evaluated, without the ramp that a constant disturbance
    causes.
    """
    with open_simulation(prepared, requested=channel.recorded) as simulation:
        flight = simulation.fly()
        if flight.status not in COMPLETE or flight.time.size < FEWEST:
            return None
        values = channel.return_signal(flight.signals, np.zeros((flight.time.size, len(channel.connectors))))
        if integrated:
            half = flight.time.size // 2
            held = np.append(0.0, np.cumsum(values[:-1] * np.diff(flight.time)))
            values = held - np.polyval(np.polyfit(flight.time[half:], held[half:], 1), flight.time)
        oscillation = find_oscillation(flight.time, values)
    return (oscillation.amplitude, oscillation.period) if oscillation else None
