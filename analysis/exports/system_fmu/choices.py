"""Variants of a system inside one FMU: one variant for each combination of candidates for its slots."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ....common.errors import InputError, suggestion
from ....common.paths import names_fmu
from ...options.option import SetValue
from ...runtime.fmi.representations import TEXTS
from ...runtime.ssp.archive import SystemArchive
from ...runtime.ssp.kinds import PARAMETERS
from ...runtime.ssp.parameter_values import parse_value
from ...runtime.system.fmu import Fmu
from ...runtime.system.network import Network, Node
from ...runtime.system.options import SystemOptions
from ...runtime.system.prepared import PreparedSystem, prepare_system

MOST_CHOICES = 64
NOT_ONE = "export the system as .ssp"


@dataclass(frozen=True)
class SlotChoice:
    """A system with one candidate in each slot: ``candidates`` by slot, and their ``numbers``, counted from 1.

    A slot is a component with several candidate FMUs, of which a parameter of the exported FMU selects one.
    """

    candidates: Mapping[str, str]
    numbers: tuple[int, ...]
    prepared: PreparedSystem

    @property
    def name(self) -> str:
        """The suffix of the choice's C functions; empty if there are no slots."""
        return "".join(f"_{number}" for number in self.numbers)


class Preparation:
    """Prepares the choices of a system, which share their loaded FMUs."""

    def __init__(self, archive: SystemArchive, options: SystemOptions, slots: Mapping[str, Sequence[str]]) -> None:
        self.archive = archive
        self.options = options
        self.slots = slots
        self._loaded: dict[str, Fmu] = {}

    def choices(self) -> list[SlotChoice]:
        """Return a choice for each combination of candidates. Raises InputError for a system that cannot be one FMU."""
        for slot, candidates in self.slots.items():
            names = [candidate_name(each) for each in candidates]
            if len(set(names)) < len(names):
                remedy = "give each candidate once, and rename files with the same name"
                raise InputError(
                    "`slots`", f"{slot}={','.join(candidates)}", "two candidates have the same name", remedy
                )
        count = 1
        for candidates in self.slots.values():
            count *= len(candidates)
        if count > MOST_CHOICES:
            raise InputError("`slots`", ", ".join(self.slots), f"{count} combinations", f"give {MOST_CHOICES} at most")
        choices = [self.choice(use) for use in self.combinations()]
        for choice in choices:
            _check(choice.prepared)
        if len({(each.prepared.start, each.prepared.step, each.prepared.steps) for each in choices}) > 1:
            steps = ", ".join(dict.fromkeys(f"{each.prepared.step:g} s" for each in choices))
            problem = f"start, step or duration of the simulation depends on the candidate (steps: {steps})"
            raise InputError("`slots`", ", ".join(self.slots), problem, "give `step` and `stop_time`")
        return choices

    def combinations(self) -> list[dict[str, str]]:
        """Return the candidate of each slot, for every choice."""
        return [dict(zip(self.slots, use, strict=True)) for use in itertools.product(*self.slots.values())]

    def choice(self, use: Mapping[str, str], *more: str) -> SlotChoice:
        """Return the system with these candidates; the parameter sets ``more`` are applied after the chosen sets.

        Raises InputError.
        """
        options = self.options
        parameters = (*options.parameters, *more)
        changed = options.replace(
            use={**options.use, **use},
            parameters=parameters,
            set=self._values_for(use),
            open_inputs="start",
        )
        prepared = self._prepare(changed)
        inputs = [name for name in system_connectors(prepared.network, "input") if name not in prepared.settings.nodes]
        for start_of in (_no_start, _start_of) if inputs else ():  # inputs with a value remain connected
            starts = {name: start_of(prepared.network, name) for name in inputs}
            prepared = self._prepare(changed.replace(set={**starts, **changed.set}))
        numbers = tuple(self.slots[slot].index(fmu) + 1 for slot, fmu in use.items())
        return SlotChoice({slot: candidate_name(fmu) for slot, fmu in use.items()}, numbers, prepared)

    def _values_for(self, use: Mapping[str, str]) -> dict[str, SetValue]:
        """Return the values of the option `set`, without values SLOT.CANDIDATE.PARAMETER of other candidates."""
        chosen = {}
        for name, number in self.options.set.items():
            slot, _, inside = name.partition(".")
            names = [each for each in map(candidate_name, self.slots.get(slot, ())) if inside.startswith(f"{each}.")]
            if not names:
                chosen[name] = number
            elif slot in use and candidate_name(use[slot]) in names:
                chosen[f"{slot}.{inside.removeprefix(f'{candidate_name(use[slot])}.')}"] = number
        return chosen

    def _prepare(self, options: SystemOptions) -> PreparedSystem:
        try:
            return prepare_system(self.archive, options, self._loaded)
        except InputError as error:
            file, remedy = error.file, error.remedy
            if "allow_unmatched" in remedy:
                remedy = "correct it; for a slot write SLOT.CANDIDATE.PARAMETER" if self.slots else "correct it"
            if file == "`use`" and set(options.use.values()) - set(self.options.use.values()):
                file = "`slots`"
            raise InputError(file, error.element, error.problem, remedy) from error


def candidate_name(use: str) -> str:
    """Return the name of a candidate: the name of its block, or the stem of its file."""
    return Path(use).stem if names_fmu(use) else use


def _start_of(network: Network, name: str) -> float | bool | str:
    """Return the start value of a system input, taken from the first component input that it drives."""
    start, node = _start_reached(network, name), network.nodes[name]
    if start is None or (node.type_name == "Enumeration" and start not in node.enumeration.values()):
        return _no_start(network, name)
    return {"Boolean": bool, "Integer": int, "Enumeration": int}.get(node.type_name or "", float)(start)


def _no_start(network: Network, name: str) -> float | bool | str:
    """Return the neutral start value of an input: 0, false, or the first item of an enumeration."""
    node = network.nodes[name]
    check_type(network, node)
    if node.enumeration:
        return next(iter(node.enumeration))
    return {"Boolean": False, "Integer": 0}.get(node.type_name or "", 0.0)


def _start_reached(network: Network, name: str) -> float | None:
    """Return the value of a connector at which the first component input that it drives has its start value.

    None is returned if the connector drives no component input through a linear conversion.
    """
    for link in network.driver.values():
        if link.source.name != name or link.transformation.table or not link.transformation.factor:
            continue
        target = link.target
        if target.component is None:
            start = _start_reached(network, target.name)
        else:
            fmu = network.fmus[target.component]
            variable = fmu.variables[target.variable]
            kind = "Integer" if variable.type == "Enumeration" else variable.type
            begin = parse_value(variable.start_text, kind, fmu.label, variable.name)
            start = None if isinstance(begin, str) else float(begin)
        if start is not None:
            return (start - link.transformation.offset) / link.transformation.factor
    return None


def check_type(network: Network, node: Node) -> None:
    """Reject a system connector of a type that no block has. Raises InputError."""
    if node.type_name in TEXTS:
        raise InputError(network.file, node.where, f"its type, {node.type_name}, is not supported", NOT_ONE)


def system_connectors(network: Network, kind: str) -> list[str]:
    """Return the system's connectors of one kind, by name."""
    return [name for name, connector in network.description.system.connectors.items() if connector.kind == kind]


def _check(prepared: PreparedSystem) -> None:
    for component, fmu in prepared.network.fmus.items():
        if not (fmu.is_own and fmu.is_native and fmu.version == 2):
            problem = f"its FMU {fmu.label} is not a native FMU of Perilune for FMI 2.0, whose C code is needed"
            raise InputError(prepared.network.file, component, problem, NOT_ONE)


def find_default(slot: str, candidates: Sequence[str], prepared: PreparedSystem, options: SystemOptions) -> int:
    """Return the number (from 1) of a slot's default candidate: the FMU in the system if it is one, else 1."""
    requested = options.use.get(slot)
    component = dict(prepared.network.components()).get(slot)
    names = [candidate_name(each) for each in candidates]
    name = candidate_name(requested) if requested else Path(component.source).stem if component else ""
    return names.index(name) + 1 if name in names else 1


def parameter_chain(network: Network, values: Mapping[str, float | str], target: str) -> list[str]:
    """Return the connectors through which a parameter gets its value, from the outermost with a value inwards.

    The last connector is ``target``. The chain is empty if no connector before it has a value.
    """
    chain = [target]
    while chain[-1] in network.driver:
        chain.append(network.driver[chain[-1]].source.name)
    for position in range(len(chain) - 1, 0, -1):
        if chain[position] in values and network.nodes[chain[position]].kind in PARAMETERS:
            return chain[position::-1]
    return []


def check_slots(slots: Mapping[str, Sequence[str]], network: Network) -> None:
    """Reject a slot without a component of the same name. Raises InputError."""
    for slot in slots:
        if slot not in network.fmus:
            raise InputError("`slots`", slot, "no such component", suggestion(slot, network.fmus))
