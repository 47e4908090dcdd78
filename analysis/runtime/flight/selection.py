"""Varied parameters and recorded signals of a simulation, for all executors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from ....common.errors import InputError, suggestion
from ...options.fault import Fault
from ..fmi.representations import TEXTS
from ..ssp.names import elements
from ..ssp.parameter_values import parse_value
from ..system.checks import check_fault
from ..system.fmu import NOT_VARIED, STRUCTURAL
from ..system.network import Network
from ..system.passing.settings import SystemSettings
from ..system.prepared import PreparedSystem
from .orders.exchanged import find_tuned
from .orders.injections import Injection, of_excitation, of_fault
from .parameters import Key
from .program import Layout

TIME_MARGIN = 1e-6  # fraction of a step, because communication points, start + n h, are rounded


@dataclass(frozen=True)
class Selection:
    """Selection of varied parameters and recorded signals.

    ``varied`` names the parameters (``component.variable``) that may change between simulations. ``requested`` names
    the signals to record (None: all outputs, connected inputs and system connectors), and ``additional`` names further
    signals. ``excited`` names the connectors to which `advance` may add signals. With ``open_end``, `advance` may pass
    the stop time.
    """

    varied: tuple[str, ...] = ()
    requested: tuple[str, ...] | None = None
    additional: tuple[str, ...] = ()
    faults: tuple[Fault, ...] = ()
    excited: tuple[str, ...] = ()
    open_end: bool = False

    def check_faults(self, network: Network) -> None:
        """Raise InputError if a fault has a target that cannot have faults."""
        for fault in self.faults:
            check_fault(network, fault)

    def keys(self, network: Network) -> dict[str, Key]:
        """Return (component, variable) of each varied parameter by name.

        Raises InputError for a name that is not a variable parameter or input.
        """
        return {name: _key(network, name) for name in self.varied}

    def settings(self, prepared: PreparedSystem, keys: Mapping[str, Key]) -> SystemSettings:
        """Return the system's settings, extended by varied parameters and by parameters that change during simulation.

        Added parameters have their start values.
        """
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
        """Return the injections of all faults, then of all excitations; ``step`` is the communication step (s)."""
        excitations = [of_excitation(name, column) for column, name in enumerate(self.excited)]
        return [*(of_fault(fault, TIME_MARGIN * step) for fault in self.faults), *excitations]

    def signal_names(self, layout: Layout, file: str) -> list[str]:
        """Return the names of the recorded signals in the order of slots. Raises InputError for an unknown name."""
        named = {*(self.requested or ()), *self.additional}
        for name in named:
            if name not in layout.slots:
                raise InputError(file, name, "no such signal", "name a variable as component.variable")
        return [name for name in layout.slots if (self.requested is None and name not in layout.unfed) or name in named]


def find_variables(network: Network, names: Sequence[str], *, is_alone: bool) -> list[str]:
    """Return the FMU variables to record, by ``component.variable``; a vector's name stands for all of its elements.

    If the FMU ``is_alone``, the component may be omitted. Raises InputError for unknown names and for Strings.
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
                "`record`",
                name,
                f"variables of type {types[variables[0]]} are not recorded",
                "name numbers and Booleans",
            )
        actual |= dict.fromkeys(variables)
    return list(actual)


def check_replaced(declared: Sequence[Fault], faults: Sequence[Fault | None]) -> None:
    """Assert that each fault is None, or has the connector and kind of the declared fault that it replaces."""
    for known, fault in zip(declared, faults, strict=True):
        assert fault is None or (fault.name, fault.kind) == (known.name, known.kind)


def _key(network: Network, name: str) -> Key:
    for component, fmu in network.fmus.items():
        variable = fmu.variables.get(name.removeprefix(f"{component}."))
        if name.startswith(f"{component}.") and variable is not None and variable.causality in ("parameter", "input"):
            return component, variable.name
        if name.startswith(f"{component}.") and variable is not None and variable.causality == STRUCTURAL:
            raise InputError(network.file, name, *NOT_VARIED)
    raise InputError(network.file, name, "no such parameter", "name a parameter or an input as component.variable")
