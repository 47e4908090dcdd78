"""Changeable parameters and recorded signals of a system, for all executors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from ....common.errors import InputError, suggestion
from ...options.fault import Fault
from ..fmi.representations import TEXTS
from ..ssp.given_values import parse_value
from ..ssp.names import elements
from ..system.checks import check_fault
from ..system.fmu import NOT_VARIED, STRUCTURAL
from ..system.network import Network
from ..system.passing.settings import Settings
from ..system.prepared import PreparedSystem
from .orders.exchanged import find_tuned
from .orders.injections import Injection, of_excitation, of_fault
from .parameters import Key
from .program import Layout

TIME_MARGIN = 1e-6  # of a step: communication points, start + n h, carry rounding


@dataclass(frozen=True)
class Selection:
    """Parameters that flights may change (``varied``, by ``component.variable``), signals to record (``wanted``, None:
    all outputs, connected inputs and system connectors), other variables to record (``more``), ``faults``, and
    connectors that `advance` may add signals to (``excited``), and ``open_end``: it may pass the stop time."""

    varied: tuple[str, ...] = ()
    wanted: tuple[str, ...] | None = None
    more: tuple[str, ...] = ()
    faults: tuple[Fault, ...] = ()
    excited: tuple[str, ...] = ()
    open_end: bool = False

    def check_faults(self, network: Network) -> None:
        """Raise InputError for a fault on anything but a connector."""
        for fault in self.faults:
            check_fault(network, fault)

    def keys(self, network: Network) -> dict[str, Key]:
        """Return (component, variable) of the varied parameters, by name. Raises InputError for one that is none."""
        return {name: _key(network, name) for name in self.varied}

    def settings(self, prepared: PreparedSystem, keys: Mapping[str, Key]) -> Settings:
        """Return the system's settings with a place for every varied parameter, and each that
        changes in flight, at its start value if need be."""
        variables = dict(prepared.settings.variables)
        tuned = find_tuned(prepared.network, {fault.name for fault in self.faults})
        changed = {name: _key(prepared.network, name) for name in sorted(tuned)}
        for name, (component, variable) in {**changed, **keys}.items():
            fmu = prepared.network.fmus[component]
            declared = fmu.variables[variable]
            variables.setdefault(
                (component, variable), parse_value(str(declared.start), declared.type, fmu.label, name)
            )
        return replace(prepared.settings, variables=variables)

    def injections(self, step: float) -> list[Injection]:
        """Return faults, then excitations; ``step`` is the communication step (s)."""
        excitations = [of_excitation(name, column) for column, name in enumerate(self.excited)]
        return [*(of_fault(fault, TIME_MARGIN * step) for fault in self.faults), *excitations]

    def signal_names(self, layout: Layout, file: str) -> list[str]:
        """Return the recorded signals, in the order of the slots. Raises InputError for an unknown one."""
        named = {*(self.wanted or ()), *self.more}
        for name in named:
            if name not in layout.slots:
                raise InputError(file, name, "no such signal", "name a variable as component.variable")
        return [name for name in layout.slots if (self.wanted is None and name not in layout.unfed) or name in named]


def find_variables(network: Network, names: Sequence[str], *, is_alone: bool) -> list[str]:
    """Return variables of FMUs to be recorded, by ``component.variable``; the name of a vector is all its elements.

    Of an FMU that flies alone the component may be left out. Raises InputError for names of none, and for Strings.
    """
    types = {
        f"{component}.{variable.name}": variable.type
        for component, fmu in network.fmus.items()
        for variable in fmu.variables.values()
    }
    actual: dict[str, None] = {}
    for name in names:
        full = f"{next(iter(network.fmus))}.{name}" if is_alone else name
        variables = elements(name, types) or elements(full, types)
        if not variables:
            known = types if not is_alone else [each.partition(".")[2] for each in types]
            raise InputError("`record`", name, "no such variable", suggestion(name, known))
        if any(types[variable] in TEXTS for variable in variables):
            raise InputError(
                "`record`", name, f"a {types[variables[0]]}, which is not recorded", "name numbers and Booleans"
            )
        actual |= dict.fromkeys(variables)
    return list(actual)


def check_replaced(declared: Sequence[Fault], faults: Sequence[Fault | None]) -> None:
    """Assert that faults of a flight have the connectors and kinds of the simulation's, or are None."""
    for known, fault in zip(declared, faults, strict=True):
        assert fault is None or (fault.name, fault.kind) == (known.name, known.kind)


def _key(network: Network, name: str) -> Key:
    for component, fmu in network.fmus.items():
        variable = fmu.variables.get(name.removeprefix(f"{component}."))
        if name.startswith(f"{component}.") and variable is not None and variable.causality in ("parameter", "input"):
            return component, variable.name
        if name.startswith(f"{component}.") and variable is not None and variable.causality == STRUCTURAL:
            raise InputError(network.file, name, *NOT_VARIED)
    raise InputError(network.file, name, "no such parameter", "see perilune list for components")
