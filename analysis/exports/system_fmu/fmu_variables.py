"""Variables of a system's FMU: declared variables, and undeclared elements of its state."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from ....fmus_src.export.description.system import EnumerationType, numbered_type
from ...runtime.fmi.variable import ScalarVariable
from ...runtime.ssp.kinds import PARAMETERS
from ...runtime.ssp.parameter_values import ParameterValue, parse_value
from ...runtime.system.network import Network, Node
from .choices import check_type, parameter_chain
from .dependence import fault_inputs
from .enumerations import Enumerations
from .model import ChoiceProgram, SlotCandidate, SystemModel

KINDS = {"Real": "KIND_REAL", "Integer": "KIND_INTEGER", "Enumeration": "KIND_INTEGER", "Boolean": "KIND_BOOLEAN"}
C_TYPES = {"KIND_REAL": "double", "KIND_INTEGER": "int64_t", "KIND_BOOLEAN": "bool"}
FAULT_KINDS = numbered_type("FaultKind", ("none", "override", "bias", "freeze"), 0)


@dataclass(frozen=True)
class FmuVariable:
    """A variable declared in modelDescription.xml; its value is at ``path`` in the system's struct.

    ``causality`` is input, output, parameter or local; an unconnected input of a component is a parameter.
    ``enumeration`` is the type of an Enumeration.
    """

    name: str
    causality: str
    type: str
    path: str
    description: str
    start: ParameterValue | None = None
    unit: str | None = None
    minimum: str | None = None
    maximum: str | None = None
    enumeration: EnumerationType | None = None
    tunable: bool = False

    @property
    def kind(self) -> str:
        """KIND_REAL, KIND_INTEGER or KIND_BOOLEAN."""
        return KINDS[self.type]

    @property
    def role(self) -> str:
        """The role, which determines whether the wrapper permits setting the variable."""
        parameter = "ROLE_TUNABLE" if self.tunable else "ROLE_PARAMETER"
        return {"input": "ROLE_INPUT", "parameter": parameter}.get(self.causality, "ROLE_OUTPUT")

    @property
    def is_member(self) -> bool:
        """True if the variable is a direct member of the system's struct."""
        return "." not in self.path and "[" not in self.path


@dataclass(frozen=True)
class PassedParameter:
    """A parameter of a component that gets its value from a system parameter.

    ``path`` is the path of the component's parameter in the system's struct. ``chain`` contains the connectors in the
    ``network`` from the system parameter to the component's parameter. ``tunable`` is True if the parameter may be set
    between steps.
    """

    path: str
    kind: str
    chain: tuple[str, ...]
    network: Network
    tunable: bool


@dataclass(frozen=True)
class TunedParameter:
    """A tunable component parameter with fault inputs; its value without faults is at ``path``."""

    candidate: SlotCandidate
    variable: ScalarVariable
    path: str

    @property
    def name(self) -> str:
        """The name of the parameter's signal."""
        return f"{self.candidate.component}.{self.variable.name}"

    @property
    def kind(self) -> str:
        """KIND_REAL, KIND_INTEGER or KIND_BOOLEAN."""
        return self.candidate.member(self.variable.name).kind


class Variables:
    """Variables of the FMU, and values of its parameters.

    ``declared`` contains the variables of the FMU, ``passed`` the component parameters that get their values from
    system parameters, and ``parameter_paths`` the paths of these system parameters by connector. ``starts`` contains
    the start values that differ from the defaults of the blocks, and ``effective`` the values of all parameters and
    inputs by name.
    """

    def __init__(self, model: SystemModel, defaults: Mapping[str, int], slots: Mapping[str, Sequence[str]]) -> None:
        self.model = model
        self.passed: list[PassedParameter] = []
        self.tuned: list[TunedParameter] = []
        self.parameter_paths: dict[str, str] = {}
        self.starts: dict[str, ParameterValue] = {}
        self.effective: dict[str, ParameterValue] = {}
        self._enumerations = Enumerations([choice.prepared.network for choice in model.choices])
        self._nodes = {name: node for choice in model.choices for name, node in choice.prepared.network.nodes.items()}
        self._values = {name: value for each in model.choices for name, value in each.prepared.settings.nodes.items()}
        system = [*self._inputs(), *self._outputs(), *self._system_parameters()]
        self.slots = {name: self._slot(name, slots[name], default) for name, default in defaults.items()}
        inside = [each for program in _by_candidate(model) for each in self._component_parameters(*program)]
        exposed = [self._expose(name) for name in model.exposed]
        system = [replace(each, tunable=self._are_readers_tunable(each)) for each in system]
        self.declared = [*system, *self.slots.values(), *inside, *exposed, *self._faults()]
        self.effective |= {each.name: each.start for each in [*system, *inside] if each.start is not None}

    def _inputs(self) -> Iterator[FmuVariable]:
        for name in self.model.inputs:
            node = self._nodes[name]
            start = _convert(node, self._values.get(name, 0.0))
            yield self._of_node(node, "input", "input", "input of the system", start)

    def _outputs(self) -> Iterator[FmuVariable]:
        for name in self.model.outputs:
            yield self._of_node(self._nodes[name], "output", "output", "output of the system")

    def _system_parameters(self) -> Iterator[FmuVariable]:
        for name, value in self._values.items():
            node = self._nodes[name]
            if node.component is None and node.kind in PARAMETERS:
                check_type(self.model.network, node)
                if parameter_chain(self.model.network, self._values, name):
                    continue  # the value comes from an outer connector
                variable = self._of_node(
                    node, "parameter", "parameter", "parameter of the system", _convert(node, value)
                )
                self.parameter_paths[name] = variable.path
                yield variable

    def _are_readers_tunable(self, declared: FmuVariable) -> bool:
        """Return True if only tunable parameters of components read a system parameter.

        A parameter that drives signals or inputs, which are set at initialisation, is fixed.
        """
        name = declared.name
        if declared.causality != "parameter":
            return False
        read = [each.tunable for each in self.passed if each.chain[0] == name]
        reached, ahead = set[str](), [name]
        links = [link for choice in self.model.choices for link in choice.prepared.network.links()]
        while ahead:
            each = ahead.pop()
            reached.add(each)
            ahead += [
                link.target.name for link in links if link.source.name == each and link.target.name not in reached
            ]
        chains = {each for passed in self.passed for each in passed.chain}
        return bool(read) and all(read) and reached <= chains

    def _of_node(
        self, node: Node, causality: str, prefix: str, description: str, start: ParameterValue | None = None
    ) -> FmuVariable:
        unit = node.unit.name if node.unit and _type_of(node) == "Real" else None
        path = self.model.members.new(f"{prefix}_{node.name}")
        enumeration = self._enumerations.of(node.name)
        type_name = _find_type(_type_of(node), enumeration)
        return FmuVariable(node.name, causality, type_name, path, description, start, unit, enumeration=enumeration)

    def _slot(self, name: str, candidates: Sequence[str], default: int) -> FmuVariable:
        path = self.model.members.new(f"use_{name}")
        about = f"which candidate is {name}; read at the initialisation"
        return FmuVariable(
            f"{name}.use",
            "parameter",
            "Enumeration",
            path,
            about,
            default,
            minimum="1",
            maximum=str(len(candidates)),
            enumeration=numbered_type(f"{name}.use.Candidate", candidates, 1),
        )

    def _component_parameters(self, program: ChoiceProgram, candidate: SlotCandidate) -> Iterator[FmuVariable]:
        network, settings = program.prepared.network, program.prepared.settings
        for variable in candidate.fmu.variables.values():
            full, path = f"{candidate.component}.{variable.name}", candidate.path_of(variable.name)
            if variable.causality == "parameter" and full in self.model.faulty:
                path = self.model.members.new(f"set_{candidate.label}.{variable.name}")
                self.tuned.append(TunedParameter(candidate, variable, path))
            assigned = settings.variables.get((candidate.component, variable.name))
            if assigned is not None:
                self.starts[path] = assigned
            if variable.causality == "parameter":
                chain = parameter_chain(network, settings.nodes, full)
                if chain:
                    if assigned is not None:
                        self.effective[f"{candidate.label}.{variable.name}"] = assigned
                    self.passed.append(
                        PassedParameter(
                            path, candidate.member(variable.name).kind, tuple(chain), network, _is_tunable(variable)
                        )
                    )
                    continue
            elif variable.causality != "input" or full in network.driver:
                continue
            enumeration = self._enumerations.in_fmu(candidate.fmu).get(variable.name)
            yield FmuVariable(
                f"{candidate.label}.{variable.name}",
                "parameter",
                _find_type(variable.type, enumeration),
                path,
                variable.description or "",
                assigned if assigned is not None else _start(variable, candidate),
                variable.unit if variable.type == "Real" else None,
                variable.minimum,
                variable.maximum,
                enumeration,
                tunable=_is_tunable(variable),
            )

    def _expose(self, name: str) -> FmuVariable:
        enumeration = self._enumerations.of(name)
        type_name = _find_type(self.model.types[name], enumeration)
        unit = self.model.units[name] if type_name == "Real" else None
        path = self.model.members.new(f"local_{name}")
        return FmuVariable(name, "local", type_name, path, self._describe(name), unit=unit, enumeration=enumeration)

    def _describe(self, name: str) -> str:
        for candidate in self.model.candidates:
            variable = candidate.fmu.variables.get(name.removeprefix(f"{candidate.component}."))
            if name.startswith(f"{candidate.component}.") and variable is not None:
                return variable.description or ""
        return ""

    def _faults(self) -> Iterator[FmuVariable]:
        for number, name in enumerate(self.model.faulty):
            path, unit = f"fault[{number}]", self.model.units[name]
            about = (
                f"fault of {name} at the end of the steps that follow: none, override by the value, bias by it, freeze"
            )
            kind, strength = fault_inputs(name)
            yield FmuVariable(
                kind,
                "input",
                "Enumeration",
                f"{path}.kind",
                about,
                0,
                enumeration=FAULT_KINDS,
            )
            is_real = self.model.types[name] == "Real"
            about = f"of an override or a bias of {name}"
            yield FmuVariable(strength, "input", "Real", f"{path}.value", about, 0.0, unit if is_real else None)


def _by_candidate(model: SystemModel) -> Iterator[tuple[ChoiceProgram, SlotCandidate]]:
    """Yield each candidate once, with the program of the first choice that contains it."""
    known: set[str] = set()
    for program in model.programs:
        for candidate in program.candidates:
            if candidate.identifier not in known:
                known.add(candidate.identifier)
                yield program, candidate


def _is_tunable(variable: ScalarVariable) -> bool:
    """Return True if the component's FMU permits setting a variable between steps."""
    return variable.variability == "tunable" or variable.causality == "input"


def _type_of(node: Node) -> str:
    return _in_a_system(node.type_name or "Real")


def _in_a_system(type_name: str) -> str:
    """Return the type of a signal between components, where an Enumeration is exchanged as an Integer."""
    return "Integer" if type_name == "Enumeration" else type_name


def _convert(node: Node, value: float | str) -> ParameterValue:
    return {"Real": float, "Integer": int, "Boolean": bool}[_type_of(node)](value)


def _start(variable: ScalarVariable, candidate: SlotCandidate) -> ParameterValue:
    return parse_value(variable.start_text, _in_a_system(variable.type), candidate.fmu.label, variable.name)


def _find_type(type_name: str, enumeration: EnumerationType | None) -> str:
    """Return the type for modelDescription.xml; an Enumeration that differs between candidates becomes an Integer."""
    return "Enumeration" if enumeration is not None else _in_a_system(type_name)
