"""C source of a system's variables: the struct with its components, start values, parameters."""

from __future__ import annotations

from collections.abc import Sequence

from ....fmus_src.export.write.layout import CodeLines
from ....fmus_src.export.write.names import comment, literal
from ...runtime.system.network import Network, NodeLink
from ...runtime.system.passing.parameters import numbers
from .choice_statements import map_value
from .fmu_variables import C_TYPES, PassedParameter, Variables
from .model import SystemModel


def write_signals(model: SystemModel) -> str:
    """Return the C enum of the signals' indices."""
    lines = CodeLines()
    lines.comment(
        "Values on their way from component to component, by number: of outputs, connected inputs, connectors."
    )
    lines.open("enum {")
    for constant in model.signals.values():
        lines.add(f"{constant},")
    lines.add("SIGNAL_COUNT")
    lines.close("};")
    return "\n".join([*lines.text, ""])


def write_struct(model: SystemModel, variables: Variables) -> str:
    lines = CodeLines()
    lines.open("typedef struct System {")
    for each in variables.declared:
        if each.is_member:
            unit = f", {each.unit}" if each.unit and each.unit != "1" else ""
            about = comment(f"{each.causality}{unit}: {each.name}, {each.description}")
            lines.member(f"{C_TYPES[each.kind]} {each.path};", about)
    declared = {each.path for each in variables.declared}
    for tuned in variables.tuned:
        if tuned.path not in declared:
            lines.member(f"{C_TYPES[tuned.kind]} {tuned.path};", comment(f"{tuned.name} without its fault"))
    for candidate in model.candidates:
        lines.member(f"{candidate.source.type_name} {candidate.identifier};", comment(f"component {candidate.label}"))
    if model.signals:
        lines.member("double signal[SIGNAL_COUNT];", "values on their way")
    if model.faulty:
        lines.member(f"FaultInput fault[{len(model.faulty)}];", comment(f"faults of {', '.join(model.faulty)}"))
    lines.member("double start_time;", "s")
    lines.member("int64_t point;", "steps since the start")
    lines.member("bool has_finished;", "the system has come to its end: nothing changes any more")
    lines.close("} System;")
    return "\n".join([*lines.text, "", "typedef System Block;", ""])


def write_starts(model: SystemModel, variables: Variables) -> str:
    lines = CodeLines()
    lines.open("static void get_starts(Block *self)\n{")
    lines.add("memset(self, 0, sizeof *self);")
    for candidate in model.candidates:
        lines.add(f"self->{candidate.identifier}.block = {candidate.source.prefix}STARTS;")
    values = {each.path: each.start for each in variables.declared if each.start is not None and each.is_member}
    for path, value in {**values, **variables.starts}.items():
        assert not isinstance(value, str)  # no block has Strings
        lines.add(f"self->{path} = {literal(value)};")
    for number in range(len(model.faulty)):
        lines.add(f"self->fault[{number}].frozen = NAN;")
    lines.close("}")
    return "\n".join([*lines.text, ""])


def write_parameters(model: SystemModel, variables: Variables) -> str:
    """Return the C function that sets component parameters from system parameters."""
    lines = CodeLines()
    lines.comment("Sets component parameters from system parameters.")
    lines.open("static void pass_parameters(Block *self, Fault *fault)\n{")
    lines.add("(void)self, (void)fault;")
    for passed in variables.passed:
        lines.open("{")
        lines.add(f"double value = (double)self->{variables.parameter_paths[passed.chain[0]]};")
        for line in convert_along_chain(passed.network, passed.chain):
            lines.add(line)
        lines.add(f"self->{passed.path} = {_cast(passed)};")
        lines.close("}")
    lines.close("}")
    return "\n".join([*lines.text, ""])


def write_use(model: SystemModel, variables: Variables) -> str:
    """Return the C function that is false for variables of candidates that are not selected."""
    lines = CodeLines()
    lines.comment("False if the variable at this offset belongs to a candidate that is not selected.")
    lines.open("static bool is_used(const Block *self, uint32_t offset)\n{")
    for candidate in model.candidates:
        slot = variables.slots.get(candidate.component)
        if slot is None or slot.enumeration is None:
            continue
        number = slot.enumeration.numbers[candidate.label.removeprefix(f"{candidate.component}.")]
        begin = f"offsetof(Block, {candidate.identifier})"
        inside = f"offset >= {begin} && offset < {begin} + sizeof self->{candidate.identifier}"
        offsets = [f"offset == offsetof(Block, {each.path})" for each in variables.tuned if each.candidate is candidate]
        where = " || ".join([f"({inside})", *offsets]) if offsets else inside
        lines.add(f"if ({where}) return self->{slot.path} == {number};")
    lines.add("(void)self, (void)offset;")
    lines.add("return true;")
    lines.close("}")
    return "\n".join([*lines.text, ""])


def convert_along_chain(network: Network, chain: Sequence[str]) -> list[str]:
    """Return the C statements that convert ``value`` from the first connector of a chain to the last."""
    return [
        line
        for number, name in enumerate(chain[1:])
        for line in _convert_over_link(network, network.driver[name], number)
    ]


def _convert_over_link(network: Network, link: NodeLink, number: int) -> list[str]:
    transformation = link.transformation
    if transformation.table:
        entries = numbers(network, link) + ([(float("nan"), float("nan"))] if transformation.is_partial else [])
        received = f"given_{number}"
        return [f"const double {received} = value;", *map_value(received, "value", entries, link.source.name)]
    return [f"value = value * {literal(transformation.factor)} + {literal(transformation.offset)};"]


def _cast(passed: PassedParameter) -> str:
    return {"KIND_REAL": "value", "KIND_INTEGER": "(int64_t)value", "KIND_BOOLEAN": "value != 0.0"}[passed.kind]
