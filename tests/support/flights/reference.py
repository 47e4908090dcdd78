"""Comparison of simulations with the reference loop: rows to the bit, and status."""

from __future__ import annotations

import random
from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from perilune.analysis.options.choices import FUSED
from perilune.analysis.options.fault import Fault
from perilune.analysis.runtime.flight.parameters import _set_once, _unreadable
from perilune.analysis.runtime.flight.results import Flight
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.program.opening import fly_reference
from perilune.analysis.runtime.program.rows import Rows
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import PreparedSystem, prepare_system


def prepared_for(system: object, steps: int | None = None, **options: object) -> PreparedSystem:
    """Prepare a system, with at most ``steps`` steps."""
    prepared = prepare_system(system, SystemOptions(**options))
    return prepared if steps is None else replace(prepared, steps=min(steps, prepared.steps))


def compare(flight: Flight, rows: Rows) -> None:
    """Assert that a flight has the reference's rows and status."""
    assert (flight.status, flight.time.tolist()) == (rows.status, rows.time), flight.message
    assert flight.signals.keys() == rows.signals.keys()
    for name, column in flight.signals.items():
        assert column.tobytes() == np.array(rows.signals[name], dtype=float).tobytes(), name


def assert_same(
    prepared: PreparedSystem, faults: Sequence[Fault] = (), requested: Collection[str] | None = None, flights: int = 2
) -> str:
    """Simulate a system by the reference loop, then ``flights`` times by the executor with
    reset instances; return the status."""
    rows = fly_reference(prepared, faults, requested)
    with Simulation(prepared, faults=faults, requested=requested) as simulation:
        for _ in range(flights):
            compare(simulation.fly(), rows)
        assert (simulation.fused_steps != 0) == (prepared.options.chosen["flavour"] == FUSED)
    return rows.status


def some_faults(prepared: PreparedSystem, seed: str) -> list[Fault]:
    """Draw biases and freezes of connected Reals and tunable parameters of a system, during a
    fraction of the simulation."""
    network, generator = prepared.network, random.Random(seed)
    reals = [
        name
        for name, link in network.driver.items()
        if link.target.component is not None and link.target.type_name == "Real" and not link.is_parameter
    ]
    tunable = [
        f"{component}.{each.name}"
        for component, fmu in network.fmus.items()
        for each in fmu.variables.values()
        if each.is_tunable and each.type == "Real"
    ]
    sources = [network.driver[name].source for name in reals]
    outputs = [node.name for node in sources if node.component is not None and node.kind == "output"]
    duration = prepared.steps * prepared.step
    faults = []
    for names in (reals, outputs, tunable):
        for kind, size in {"bias": 1e-3, "freeze": 0.0}.items() if names else ():
            start = prepared.start + generator.choice((0.0, 0.2, 0.5)) * duration
            bias = size * generator.random()
            faults.append(Fault(generator.choice(names), kind, bias, start, start + 0.3 * duration))
    return faults


def fly_again(simulation: Simulation, flight: Flight) -> bool:
    """Compare a flight that has just begun and ended with the reference's, where that has the same calls.

    False without a comparison: of an FMU that refused a call and is no longer asked, and of flights that ended for a
    reason outside of them.
    """
    prepared, parameters = simulation.prepared, simulation.layout.parameters
    learned = any(fmu.digest in _set_once or fmu.digest in _unreadable for fmu in prepared.network.fmus.values())
    if learned or prepared.is_alone or flight.status == "interrupted":
        return False
    values = {key: parameters[key] for key in simulation.settings.variables if key in parameters}
    varied = replace(prepared.settings, variables=prepared.settings.variables | values)
    selection, faults = simulation._selection, [fault for fault in simulation._faults if fault is not None]
    rows = fly_reference(replace(prepared, settings=varied), faults, selection.requested)
    compare(flight, rows)
    return True
