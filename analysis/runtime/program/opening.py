"""Reference loop for a prepared system: instantiates its FMUs, simulates once, and frees them."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Error

from ...options.fault import Fault
from ..instances.instance import Instance, instantiate
from ..system.prepared import PreparedSystem
from .component import ComponentInstance
from .exchange import Exchange
from .faults import Faults
from .fmi2_component import Fmi2Component
from .fmi3_component import Fmi3Component
from .reference_loop import Jacobi, Sequential
from .rows import Rows
from .signals import Signals
from .start_values import find_starts

LOOPS = {"sequential": Sequential, "jacobi": Jacobi}


def fly_reference(
    system: PreparedSystem, faults: Sequence[Fault] = (), selected: Collection[str] | None = None
) -> Rows:
    """Simulate a system once in this process; record the ``selected`` signals, or all exchanged signals if it is None.

    Raises InputError if an FMU cannot be instantiated.
    """
    exchange = Exchange(system, faults, selected)
    instances: dict[str, Instance] = {}
    is_fatal = False
    try:
        for name, fmu in system.network.fmus.items():
            instances[name] = instantiate(fmu, name, uses_events=exchange.roles[name].uses_events)
        components = {name: _component(system, exchange, instance) for name, instance in instances.items()}
        signals = Signals(system, exchange, Faults(faults, system.step))
        loop = LOOPS[system.algorithm](system, components, signals)
        status = loop.fly()
        is_fatal = isinstance(loop.refusal, FMICallException) and loop.refusal.status > fmi2Error
        for instance in instances.values() if loop.refusal is None else ():
            instance.slave.terminate()
    finally:
        for instance in instances.values():
            (instance.abandon if is_fatal else instance.free)()  # must not be freed after fmi2Fatal
    return Rows(signals.times, signals.rows, status)


def _component(system: PreparedSystem, exchange: Exchange, instance: Instance) -> ComponentInstance:
    name, roles = instance.name, exchange.roles[instance.name]
    tuned = {f"{name}.{each.name}" for each in roles.inputs if each.is_tunable}
    starts = find_starts(system.network, system.settings, name, tuned)
    if instance.fmu.version == 2:
        return Fmi2Component(name, instance.fmu, instance.slave, starts)
    return Fmi3Component(name, instance.fmu, instance.slave, starts, uses_events=roles.uses_events)
