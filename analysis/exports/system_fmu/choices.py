"""The systems that one FMU has inside: one for each choice of candidates in its slots."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ....fmus_src.paths import names_fmu
from ...common.errors import InputError, suggestion
from ...runtime.ssp.archive import SystemArchive
from ...runtime.ssp.kinds import PARAMETERS
from ...runtime.system.fmu import Fmu
from ...runtime.system.network import Network
from ...runtime.system.options import SystemOptions
from ...runtime.system.prepared import PreparedSystem, prepare_system

MOST_CHOICES = 64


@dataclass(frozen=True)
class Choice:
    """A system with one candidate in each slot: ``candidates`` by slot."""

    candidates: Mapping[str, str]
    prepared: PreparedSystem

    @property
    def name(self) -> str:
        """For functions of C; empty where there is nothing to choose."""
        return "".join(f"_{candidate}" for candidate in self.candidates.values())


class Preparation:
    """Prepares the choices of a system, with the FMUs that are loaded already."""

    def __init__(self, archive: SystemArchive, options: SystemOptions, slots: Mapping[str, Sequence[str]]) -> None:
        self.archive = archive
        self.options = options
        self.slots = slots
        self._loaded: dict[str, Fmu] = {}

    def choices(self) -> list[Choice]:
        """One for each combination of candidates. Raises InputError for a system that cannot be one FMU."""
        for slot, candidates in self.slots.items():
            names = [candidate_name(each) for each in candidates]
            if len(set(names)) < len(names):
                raise InputError("`slots`", f"{slot}={','.join(candidates)}", "names a candidate twice", "give it once")
        count = 1
        for candidates in self.slots.values():
            count *= len(candidates)
        if count > MOST_CHOICES:
            raise InputError("`slots`", ", ".join(self.slots), f"{count} combinations", f"give {MOST_CHOICES} at most")
        choices = [self.choice(use) for use in self.combinations()]
        for choice in choices:
            _check(choice.prepared)
        return choices

    def combinations(self) -> list[dict[str, str]]:
        """What takes the place of each slot's component, for every choice."""
        return [dict(zip(self.slots, use, strict=True)) for use in itertools.product(*self.slots.values())]

    def choice(self, use: Mapping[str, str], *more: str) -> Choice:
        """The system with these candidates and, behind the chosen ones, ``more`` parameter sets. Raises InputError."""
        options = self.options
        changed = replace(options, use={**options.use, **use}, parameters=(*options.parameters, *more))
        prepared = prepare_system(self.archive, replace(changed, open_inputs="start"), self._loaded)
        inputs = system_connectors(prepared.network, "input")
        starts = {"Boolean": False, "Integer": 0, "Enumeration": 0}
        values = {
            name: starts.get(prepared.network.nodes[name].type_name or "", 0.0)
            for name in inputs
            if name not in prepared.settings.nodes
        }
        # With a value inputs are connectors whose value is known, and remain connected.
        prepared = prepare_system(self.archive, replace(changed, set={**values, **changed.set}), self._loaded)
        return Choice({slot: candidate_name(fmu) for slot, fmu in use.items()}, prepared)


def candidate_name(use: str) -> str:
    """The name of a candidate, of a block or of a file."""
    return Path(use).stem if names_fmu(use) else use


def system_connectors(network: Network, kind: str) -> list[str]:
    """The connectors of the system itself that are of this kind."""
    return [name for name, connector in network.description.system.connectors.items() if connector.kind == kind]


def _check(prepared: PreparedSystem) -> None:
    for component, fmu in prepared.network.fmus.items():
        if not (fmu.is_own and fmu.is_native and fmu.version == 2):
            problem = f"its FMU {fmu.label} is not a native one of Perilune for FMI 2.0, whose C would be needed"
            raise InputError(prepared.network.file, component, problem, "export the system as .ssp")


def find_default(slot: str, candidates: Sequence[str], prepared: PreparedSystem, options: SystemOptions) -> int:
    """Which of a slot's candidates flies where nobody chooses: that of the system, else the first; counted from 1."""
    given = options.use.get(slot)
    component = dict(prepared.network.components()).get(slot)
    names = [candidate_name(each) for each in candidates]
    wanted = candidate_name(given) if given else Path(component.source).stem if component else ""
    return names.index(wanted) + 1 if wanted in names else 1


def parameter_chain(network: Network, values: Mapping[str, float | str], target: str) -> list[str]:
    """The connectors that bring a parameter its value, from the outermost that has one down to ``target``."""
    chain = [target]
    while chain[-1] in network.driver:
        chain.append(network.driver[chain[-1]].source.name)
    for position in range(len(chain) - 1, 0, -1):
        if chain[position] in values and network.nodes[chain[position]].kind in PARAMETERS:
            return chain[position::-1]
    return []


def check_slots(slots: Mapping[str, Sequence[str]], network: Network) -> None:
    """Refuse a slot that is no component. Raises InputError."""
    for slot in slots:
        if slot not in network.fmus:
            raise InputError("`slots`", slot, "no such component", suggestion(slot, network.fmus))
