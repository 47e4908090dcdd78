"""C source of a system: a struct of its components, its variables, and its steps for each choice of candidates."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from ....fmus_src.export.write.layout import CodeLines
from ....fmus_src.export.write.names import comment, literal
from ....fmus_src.runtime import POINT_TOLERANCE, SAMPLE_TOLERANCE, STEP_LIMIT, TIME_TOLERANCE
from ...runtime.flight.instructions import write_renewal
from ...runtime.flight.orders.slots import BASE
from ...runtime.ssp.kinds import PARAMETERS
from .choice_statements import ChoiceStatements, quoted
from .choices import parameter_chain
from .component_source import file_name
from .fmu_variables import FmuVariable, Variables
from .model import ChoiceProgram, SystemModel
from .tables_in_c import write_tables
from .variables_in_c import (
    convert_along_chain,
    write_parameters,
    write_signals,
    write_starts,
    write_struct,
    write_use,
)

SIGNALS = "double *const s = self->signal;\n    (void)s;"  # the first statements of a step
HEADER = """\
/* {name}: {about}
 *
 * A system of {count} components as one FMU, written by Perilune from its description and the C of their FMUs.
 * Nothing is global: instances are independent of one another and may run in different threads.
 *
 * Compile with -std=c99 -O2 -ffp-contract=off -fno-tree-vectorize and link with -lm: then every result has the bits
 * of the system flown by Perilune. To link several FMUs into one program, define FMI2_FUNCTION_PREFIX={name}_.
 */
#include "block_elements.h"

#define SAMPLE_TOLERANCE {sample!r} /* of a sample period */
#define TIME_TOLERANCE {time!r} /* of the time */
#define POINT_TOLERANCE {point!r} /* of a step */
#define STEP_LIMIT {most_steps} /* of integration in a step */
#define SYSTEM_STEP {step} /* s */

#include "sampling.h"
#include "system_statements.h"

{includes}
"""
FOOTER = """\
#define HAS_FINISHED(component) ((component)->now.block.has_finished)

#include "fmi2_wrapper.h"
#include "system_steps.h"
"""


def write_system(name: str, about: str, guid: str, model: SystemModel, variables: Variables) -> str:
    """Return the main source file of the FMU with this GUID; it includes all other source files."""
    header = HEADER.format(
        name=name,
        about=comment(about),
        count=len(model.network.fmus),
        sample=SAMPLE_TOLERANCE,
        time=TIME_TOLERANCE,
        point=POINT_TOLERANCE,
        most_steps=STEP_LIMIT,
        step=literal(model.first.step),
        includes="\n".join(f'#include "{file_name(source)}"' for source in model.sources),
    )
    return "\n".join(
        [
            header,
            write_signals(model),
            write_struct(model, variables),
            write_tables(guid, model, variables),
            write_starts(model, variables),
            write_parameters(model, variables),
            write_use(model, variables),
            *(text for program in model.programs for text in _functions(program, model, variables)),
            _entry_points(model, variables),
            FOOTER,
        ]
    )


def _functions(program: ChoiceProgram, model: SystemModel, variables: Variables) -> list[str]:
    """Return the initialisation and step functions of one choice."""
    statements = ChoiceStatements(program, model.signals)
    initialise = CodeLines()
    initialise.open(f"static void initialize{program.choice.name}(Block *self, Fault *fault)\n{{")
    initialise.add(SIGNALS if model.signals else "(void)self;")
    passed = _find_passed_signals(program, variables)
    for name, start in program.starts.items():
        if name not in passed and name not in model.inputs:
            initialise.add(f"s[{model.signals[name]}] = {literal(start)};")
    for name, chain in passed.items():
        initialise.open("{")
        initialise.add(f"double value = (double)self->{variables.parameter_paths[chain[0]]};")
        for line in convert_along_chain(program.prepared.network, chain):
            initialise.add(line)
        initialise.add(f"s[{model.signals[name]}] = value;")
        initialise.close("}")
    for line in [
        *_check_faults(model),
        *_take_inputs(program, model, variables),
        *statements.initialisation(),
        *_end_step(statements, model, variables),
    ]:
        initialise.add(line)
    initialise.close("}")
    step = CodeLines()
    step.comment("From one communication point to the next.")
    step.open(f"static void step{program.choice.name}(Block *self, Fault *fault)\n{{")
    step.add(SIGNALS if model.signals else "(void)self;")
    step.add("const double time = self->start_time + (double)self->point * SYSTEM_STEP;")
    for line in [*_check_faults(model), *_take_inputs(program, model, variables)]:
        step.add(line)
    phases = len(program.program.phases) - 1
    if phases > 1:
        step.open(f"switch (self->point % {phases}) {{")
    for phase in range(phases):
        if phases > 1:
            step.open(f"case {phase}:")
        for line in [*_renewal(statements, phase), *statements.step(phase)]:
            step.add(line)
        if phases > 1:
            step.add("break;")
            step.depth -= 1
    if phases > 1:
        step.close("}")
    step.add("self->point += 1;")
    for line in _end_step(statements, model, variables):
        step.add(line)
    step.add("(void)time, (void)fault;")
    step.close("}")
    return ["\n".join([*initialise.text, ""]), "\n".join([*step.text, ""])]


def _take_inputs(program: ChoiceProgram, model: SystemModel, variables: Variables) -> list[str]:
    """Return the statements that read values set by the importer: system inputs, and parameters with fault inputs."""
    paths = {each.name: each.path for each in variables.declared}
    sources = {model.signals[name]: paths[name] for name in model.inputs if name in model.signals}
    for tuned in variables.tuned:
        if tuned.candidate in program.candidates:
            sources[model.signals[f"{tuned.name}{BASE}"]] = tuned.path
    return [f"s[{signal}] = (double)self->{path};" for signal, path in sources.items()]


def _renewal(statements: ChoiceStatements, phase: int) -> list[str]:
    """Return the statements that pass system inputs and faulty parameters to components at the start of a step.

    Only components that step with the inputs at the start of the step need these statements.
    """
    program = statements.choice
    prepared = program.prepared
    names = list(prepared.network.fmus)
    rows = write_renewal(program.instructions, names, prepared.schedule, prepared.algorithm, prepared.periods, phase)
    return [line for component, each in rows.items() for line in statements.renewal(component, each)]


def _find_passed_signals(program: ChoiceProgram, variables: Variables) -> dict[str, list[str]]:
    """Return the system parameters that are signals, each with its chain of connectors from the one with the value."""
    network, values = program.prepared.network, program.prepared.settings.nodes
    nodes = (network.nodes[name] for name in program.layout.slots if name in network.nodes)
    names = [node.name for node in nodes if node.component is None and node.kind in PARAMETERS]
    chains = {name: parameter_chain(network, values, name) or [name] for name in names}
    return {name: chain for name, chain in chains.items() if chain[0] in variables.parameter_paths}


def _check_faults(model: SystemModel) -> list[str]:
    """Return the statements that check the fault inputs."""
    kinds = {"Real": "KIND_REAL", "Boolean": "KIND_BOOLEAN"}
    return [
        f"CHECK_FAULT(self->fault[{number}], {kinds.get(model.types[name], 'KIND_INTEGER')}, {quoted(f'fault.{name}')})"
        for number, name in enumerate(model.faulty)
    ]


def _end_step(statements: ChoiceStatements, model: SystemModel, variables: Variables) -> list[str]:
    """Return the statements at the end of a step: termination of the system, applied faults, outputs."""
    program = statements.choice
    finished = program.program.finished_slot
    lines = [f"self->has_finished = {statements.signal(finished)} != 0.0;"] if finished >= 0 else []
    lines += [f"note_fault(&self->fault[{number}]);" for number in range(len(model.faulty))]
    for each in variables.declared:
        if each.causality in ("output", "local") and each.name in program.layout.slots:
            signal = f"s[{model.signals[each.name]}]"
            convert = {"KIND_REAL": signal, "KIND_INTEGER": f"(int64_t){signal}", "KIND_BOOLEAN": f"{signal} != 0.0"}
            if each.kind == "KIND_INTEGER" and model.faulty:  # a biased value may be fractional
                lines.append(f"CHECK_WHOLE({signal}, {quoted(each.name)})")
            lines.append(f"self->{each.path} = {convert[each.kind]};")
    return lines


def _entry_points(model: SystemModel, variables: Variables) -> str:
    """Return the functions that the wrapper calls; they select the choice from the slot parameters."""
    lines = CodeLines()
    lines.open("static void model_set_start_time(Block *self, double start_time)\n{")
    lines.add("self->start_time = start_time;")
    lines.close("}")
    lines.text.append("")
    for function in ("initialize", "step"):
        lines.open(f"static void model_{function}(Block *self, Fault *fault)\n{{")
        _dispatch(lines, function, model.programs, list(variables.slots.values()))
        lines.close("}")
        lines.text.append("")
    return "\n".join(lines.text)


def _dispatch(lines: CodeLines, function: str, programs: Sequence[ChoiceProgram], slots: Sequence[FmuVariable]) -> None:
    """Add a call of each choice's function, on the condition that the slot parameters select this choice.

    ``programs`` are ordered with the candidate of the last slot varying fastest.
    """
    numbers_of = itertools.product(*(slot.enumeration.numbers.values() for slot in slots if slot.enumeration))
    for program, chosen in zip(programs, numbers_of, strict=True):
        tests = " && ".join(f"self->{slot.path} == {number}" for slot, number in zip(slots, chosen, strict=True))
        call = f"{function}{program.choice.name}(self, fault);"
        lines.add(f"if ({tests}) {call}" if tests else call)
