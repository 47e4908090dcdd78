"""Exchanged and recorded variables of a system."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from ...fmi.variable import ScalarVariable
from ...ssp.kinds import PARAMETERS
from ...ssp.names import split_name
from ...system.network import Network
from .injections import Injection


class Exchanged:
    """Names of a system's variables by their use in a simulation.

    ``requested`` and ``additional`` are as in `Choices`. ``fetched`` contains the outputs to get (None: all), and
    ``named`` the variables recorded by request, of any causality. ``other_sources`` contains variables that are
    connected as sources but are no outputs, ``passed_parameters`` parameters of systems through which signals pass, and
    ``tuned`` tunable parameters that are driven over time or have faults.
    """

    def __init__(
        self,
        network: Network,
        requested: Collection[str] | None,
        additional: Collection[str],
        injections: Sequence[Injection],
    ) -> None:
        self._network = network
        read = {link.source.name for link in network.links()}
        faulty = {injection.connector for injection in injections}
        self.fetched = None if requested is None else read | set(requested) | set(additional) | faulty
        self.tuned = find_tuned(network, faulty)
        self.named = {*(requested or ()), *additional}
        signals = [link.source for link in network.links() if not link.is_parameter]
        self.other_sources = {node.name for node in signals if node.component is not None and node.kind != "output"}
        self.passed_parameters = {node.name for node in signals if node.component is None and node.kind in PARAMETERS}

    def is_tuned(self, component: str, variable: ScalarVariable) -> bool:
        """Return True if a tunable parameter changes during simulation."""
        return f"{component}.{variable.name}" in self.tuned

    def is_set(self, name: str) -> bool:
        """Return True if an input is connected or driven over time."""
        return name in self._network.driver or name in self._network.driven

    def is_fetched(self, name: str) -> bool:
        """Return True if an output is to be read, because it is connected, recorded or has a fault."""
        return self.fetched is None or name in self.fetched


def find_tuned(network: Network, faulty: Collection[str]) -> set[str]:
    """Return the names of tunable parameters that are driven over time or listed in ``faulty``."""
    tuned = set()
    for name in {*network.driven, *faulty}:
        component, short = split_name(name, network.fmus)
        variable = network.fmus[component].variables.get(short) if component else None
        if variable is not None and variable.is_tunable:
            tuned.add(name)
    return tuned
