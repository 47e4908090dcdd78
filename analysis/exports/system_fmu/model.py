"""Model of a system's FMU with all candidates: components with their C source, signals, C identifiers."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import PurePath

from ....common.errors import InputError
from ....fmus_src.export.native_fmu import read_wrapper
from ....fmus_src.export.write.names import RESERVED
from ...runtime.flight.instructions import InstructionList
from ...runtime.flight.orders.injections import Injection
from ...runtime.flight.orders.instruction_rows import Unloaded
from ...runtime.flight.program import Layout, build_program
from ...runtime.flight.selection import find_variables
from ...runtime.loop import arrays, codes
from ...runtime.system.checks import changeable
from ...runtime.system.fmu import Fmu
from ...runtime.system.network import Network
from ...runtime.system.prepared import PreparedSystem
from .choices import SlotChoice, check_type, system_connectors
from .component_source import BlockCode, StructMember, read_component_source

DEFINE = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)", re.MULTILINE)
# Headers of the C library, which a file of the same name would replace.
C_LIBRARY = frozenset(
    re.findall(
        r"\w+",
        """
        assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdarg stdbool stddef
        stdint stdio stdlib string tgmath time
        """,
    )
)
ALWAYS = (float("-inf"), float("inf"))


@dataclass(frozen=True)
class SlotCandidate:
    """A component, or a candidate of a slot.

    ``identifier`` is its name in the C code, ``label`` the prefix of its variables' names.
    """

    component: str
    fmu: Fmu
    source: BlockCode
    identifier: str
    label: str

    def member(self, variable: str) -> StructMember:
        """Return the struct member of a variable."""
        return self.source.members[self.fmu.variables[variable].reference]

    def path_of(self, variable: str) -> str:
        """Return the path of a variable inside the system's struct."""
        return f"{self.identifier}.block.{self.member(variable).path}"


@dataclass
class Identifiers:
    """Generator of unique C identifiers; ``used`` contains the identifiers already in use."""

    used: set[str] = field(default_factory=set)

    def new(self, text: str) -> str:
        """Return an unused identifier for a text, with a number appended if necessary."""
        base = re.sub(r"\W+", "_", text, flags=re.ASCII).strip("_") or "x"
        name = base = f"n_{base}" if base[0].isdigit() else base
        number = 2
        while name in self.used:
            name, number = f"{base}_{number}", number + 1
        self.used.add(name)
        return name


@dataclass(frozen=True)
class ChoiceProgram:
    """The program of one choice, and the instruction list from which it was assembled.

    ``candidates`` are in the order of component numbers.
    """

    choice: SlotChoice
    program: arrays.Program
    instructions: InstructionList
    layout: Layout
    candidates: Sequence[SlotCandidate]

    @property
    def prepared(self) -> PreparedSystem:
        return self.choice.prepared

    @cached_property
    def names(self) -> list[str]:
        """The name of the signal in each slot of the program."""
        return list(self.layout.slots)

    @property
    def starts(self) -> dict[str, float]:
        """The initial values by signal, for signals with a value before the first exchange."""
        initial = zip(self.names, self.program.initial.tolist(), strict=True)
        return {name: start for name, start in initial if not math.isnan(start)}


class SystemModel:
    """Model of the FMU: choices, candidates, signals and C identifiers.

    The signals ``exposed`` become local variables of the FMU. The FMU has fault inputs for the connectors and tunable
    parameters ``faulty``. Raises InputError for unknown names, and for C source from another build.
    """

    def __init__(self, choices: Sequence[SlotChoice], exposed: Sequence[str], faulty: Sequence[str]) -> None:
        self.choices = choices
        self.first = choices[0].prepared
        self.members = Identifiers({*RESERVED, *_macros(), "point", "start_time", "has_finished", "signal", "fault"})
        self._candidates: dict[tuple[str, str], SlotCandidate] = {}
        self._sources: dict[str, BlockCode] = {}
        self._prefixes = Identifiers(
            {"model", *C_LIBRARY, *(PurePath(file).stem for file in read_wrapper(2, "system"))}
        )
        self.exposed = self._find_exposed(exposed)
        self.faulty = _find_faulty(choices, faulty)
        self.programs = [self._program(choice) for choice in choices]
        signals = dict.fromkeys(name for program in self.programs for name in program.layout.slots)
        self._constants = Identifiers()
        self.signals = {name: self._constants.new(f"S_{name}".upper()) for name in signals}
        for name in self.exposed:
            if name not in signals:
                raise InputError(
                    "`expose`", name, "not a signal of the system", "name a variable as component.variable"
                )
        self.types = {name: kind for program in self.programs for name, kind in program.layout.types.items()}
        self.units = {name: unit for program in self.programs for name, unit in program.layout.units.items()}
        for name in (*self.exposed, *self.faulty):
            self._check_alike(name)

    @property
    def candidates(self) -> list[SlotCandidate]:
        return list(self._candidates.values())

    @property
    def sources(self) -> list[BlockCode]:
        return list(self._sources.values())

    @property
    def network(self) -> Network:
        return self.first.network

    @cached_property
    def inputs(self) -> list[str]:
        """The names of the system's inputs."""
        return system_connectors(self.network, "input")

    @cached_property
    def outputs(self) -> list[str]:
        """The names of the system's outputs that have a source."""
        names = system_connectors(self.network, "output")
        for name in names:
            check_type(self.network, self.network.nodes[name])
        return [name for name in names if name in self.signals]

    def _check_alike(self, name: str) -> None:
        """Reject a signal with a type or unit that differs between candidates, since a single variable represents it.

        Raises InputError.
        """
        layouts = [program.layout for program in self.programs if name in program.layout.slots]
        kinds = {
            f"{layout.types[name].replace('Enumeration', 'Integer')} in {layout.units[name] or '1'}": None
            for layout in layouts
        }
        if len(kinds) > 1:
            problem = f"{', '.join(kinds)}, depending on the candidate: one variable cannot represent both"
            raise InputError(
                "`slots`", name, problem, "leave this variable out of `expose` and `faults`, or remove a candidate"
            )

    def _program(self, choice: SlotChoice) -> ChoiceProgram:
        prepared = choice.prepared
        instances = dict.fromkeys(prepared.network.fmus, Unloaded())
        injections = [Injection(name, codes.OVERRIDE, 0.0, ALWAYS) for name in self.faulty]
        known = [name for name in self.exposed if _is_known(prepared.network, name)]
        program, _, instructions, layout = build_program(prepared, prepared.settings, instances, known, injections)
        candidates = [self._candidate(choice, name, fmu) for name, fmu in prepared.network.fmus.items()]
        return ChoiceProgram(choice, program, instructions, layout, candidates)

    def _candidate(self, choice: SlotChoice, component: str, fmu: Fmu) -> SlotCandidate:
        candidate = choice.candidates.get(component, "")
        if (component, candidate) not in self._candidates:
            path = f"{component}.{candidate}" if candidate else component
            if fmu.digest not in self._sources:
                self._sources[fmu.digest] = read_component_source(fmu, self._prefixes.new(fmu.name.lower()))
            source = self._sources[fmu.digest]
            self._candidates[component, candidate] = SlotCandidate(component, fmu, source, self.members.new(path), path)
        return self._candidates[component, candidate]

    def _find_exposed(self, names: Sequence[str]) -> list[str]:
        """Return the variables to which these names refer, in any candidate. Raises InputError."""
        exposed: dict[str, None] = {}
        for name in names:
            error = None
            if name in self.network.description.system.connectors:
                raise InputError(
                    "`expose`",
                    name,
                    "a connector of the system, which is always a variable of the FMU",
                    "leave the connector out of `expose`",
                )
            nodes = [choice.prepared.network.nodes.get(name) for choice in self.choices]
            if any(node is not None and node.component is None and "." in name for node in nodes):
                exposed[name] = None  # a connector of a nested system
                continue
            for choice in self.choices:
                try:
                    exposed |= dict.fromkeys(find_variables(choice.prepared.network, [name], is_alone=False))
                except InputError as problem:
                    error = error or problem
            if error is not None and not any(each == name or each.startswith(f"{name}[") for each in exposed):
                raise InputError("`expose`", name, error.problem, error.remedy)
        for name in exposed:
            if any(self._is_parameter(choice.prepared.network, name) for choice in self.choices):
                raise InputError(
                    "`expose`",
                    name,
                    "a parameter, which is always a parameter of the FMU",
                    "leave the parameter out of `expose`",
                )
        return list(exposed)

    @staticmethod
    def _is_parameter(network: Network, name: str) -> bool:
        return any(
            name == f"{component}.{variable.name}"
            and (variable.causality == "parameter" or (variable.causality == "input" and name not in network.driver))
            for component, fmu in network.fmus.items()
            for variable in fmu.variables.values()
        )


def _macros() -> set[str]:
    """Return the macro names that C identifiers must avoid."""
    texts = [text.decode() for text in read_wrapper(2, "system").values()]
    ours = {
        "SAMPLE_TOLERANCE",
        "TIME_TOLERANCE",
        "POINT_TOLERANCE",
        "STEP_LIMIT",
        "SYSTEM_STEP",
        "MODEL_GUID",
        "HAS_FINISHED",
    }
    return {*ours, *(name for text in texts for name in DEFINE.findall(text))}


def _is_known(network: Network, name: str) -> bool:
    return any(
        name.startswith(f"{component}.") and name.removeprefix(f"{component}.") in fmu.variables
        for component, fmu in network.fmus.items()
    )


def _find_faulty(choices: Sequence[SlotChoice], names: Sequence[str]) -> list[str]:
    """Return the connectors and tunable parameters with fault inputs, common to all choices. Raises InputError."""
    for name in names:
        for choice in choices:
            changeable(choice.prepared.network, name, ("`faults`", name), tunable=True)
    if len(set(names)) < len(names):
        raise InputError("`faults`", ", ".join(names), "names a connector twice", "name each connector once")
    return list(names)
