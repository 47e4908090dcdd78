"""The C of a system's variables: the struct with its components, the tables by value reference, starts, parameters."""

from __future__ import annotations

from collections.abc import Sequence

from ....fmus_src.export.write.layout import Lines
from ....fmus_src.export.write.names import comment, literal
from ...runtime.system.network import Link, Network
from ...runtime.system.passing.parameters import numbers
from .model import SystemModel
from .statements import map_value, quoted
from .variables import C_TYPES, Passed, Variables


def write_signals(model: SystemModel) -> str:
    """Their numbers."""
    lines = Lines()
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
    lines = Lines()
    lines.open("typedef struct System {")
    for each in variables.declared:
        if each.is_member:
            unit = f", {each.unit}" if each.unit and each.unit != "1" else ""
            about = comment(f"{each.causality}{unit}: {each.name}, {each.description}")
            lines.member(f"{C_TYPES[each.kind]} {each.path};", about)
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


def _hidden(model: SystemModel, variables: Variables) -> list[tuple[str, str, str]]:
    """Name, path and kind of what the state has and modelDescription.xml does not declare."""
    declared = {each.path for each in variables.declared}
    hidden = []
    for candidate in model.candidates:
        for variable in candidate.fmu.variables.values():
            if candidate.path_of(variable.name) not in declared:
                kind = candidate.member(variable.name).kind
                hidden.append((f"{candidate.label}.{variable.name}", candidate.path_of(variable.name), kind))
        hidden.append((f"{candidate.label}, its samples", f"{candidate.identifier}.tick", "KIND_INTEGER"))
    hidden += [(f"signal {name}", f"signal[{constant}]", "KIND_REAL") for name, constant in model.signals.items()]
    for number, name in enumerate(model.faulty):
        hidden.append((f"{name}, frozen", f"fault[{number}].frozen", "KIND_REAL"))
        hidden.append((f"{name}, kind of the last step", f"fault[{number}].last_kind", "KIND_INTEGER"))
        hidden.append((f"{name}, value of the last step", f"fault[{number}].last_value", "KIND_REAL"))
    return [
        *hidden,
        ("start time", "start_time", "KIND_REAL"),
        ("steps", "point", "KIND_INTEGER"),
        ("end", "has_finished", "KIND_BOOLEAN"),
    ]


def write_tables(guid: str, model: SystemModel, variables: Variables) -> str:
    """What the wrapper needs to know: GUID, and tables by value reference, of what is not declared last."""
    rows = [(each.name, each.path, each.kind, each.role) for each in variables.declared]
    rows += [(name, path, kind, "ROLE_STATE") for name, path, kind in _hidden(model, variables)]
    lines = Lines()
    lines.add(f'#define MODEL_GUID "{guid}"')
    lines.text.append("")
    lines.comment(f"By value reference; those from {len(variables.declared)} on belong to the state alone.")
    lines.open("static const Element ELEMENTS[] = {")
    for _, path, kind, role in rows:
        lines.add(f"{{offsetof(Block, {path}), {kind} | {role}, 1}},")
    lines.close("};")
    lines.text.append("")
    lines.comment("For messages.")
    names = ", ".join(quoted(name) for name, *_ in rows)
    lines.add(f"static const char *const NAMES[] = {{{names}}};")
    return "\n".join([*lines.text, ""])


def write_starts(model: SystemModel, variables: Variables) -> str:
    lines = Lines()
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
    """The parameters of components that follow from those of systems."""
    lines = Lines()
    lines.comment("Parameters of components that follow from those of systems.")
    lines.open("static void pass_parameters(Block *self, Fault *fault)\n{")
    lines.add("(void)self, (void)fault;")
    for passed in variables.passed:
        lines.open("{")
        lines.add(f"double value = (double)self->{variables.parameter_paths[passed.chain[0]]};")
        for line in pass_along(passed.network, passed.chain):
            lines.add(line)
        lines.add(f"self->{passed.path} = {_converted(passed)};")
        lines.close("}")
    lines.close("}")
    return "\n".join([*lines.text, ""])


def pass_along(network: Network, chain: Sequence[str]) -> list[str]:
    """The ``value`` of a system's parameter, the first of a chain of connectors, to that of the last."""
    return [line for number, name in enumerate(chain[1:]) for line in _pass_on(network, network.driver[name], number)]


def _pass_on(network: Network, link: Link, number: int) -> list[str]:
    transformation = link.transformation
    if transformation.table:
        entries = numbers(network, link) + ([(float("nan"), float("nan"))] if transformation.is_partial else [])
        given = f"given_{number}"
        return [f"const double {given} = value;", *map_value(given, "value", entries, link.source.name)]
    return [f"value = value * {literal(transformation.factor)} + {literal(transformation.offset)};"]


def _converted(passed: Passed) -> str:
    return {"KIND_REAL": "value", "KIND_INTEGER": "(int64_t)value", "KIND_BOOLEAN": "value != 0.0"}[passed.kind]
