"""Translation of a block to one readable C99 file: struct, kernel, tables for the FMI wrapper."""

from __future__ import annotations

import inspect
from functools import cache
from pathlib import Path

from ...block import Block
from ...kernel import vector_types
from ...kernel.functions import DOMAIN_ERROR, EITHER_ERROR, FAULTS, RANGE_ERROR
from ...roles import SAMPLE_PERIOD, START_TIME
from ...runtime import integration_step
from ...variables import Variable
from ..judge.expressions import SCALARS, type_of_variable
from ..judge.kernel import FLOAT, INT, Function, Kernel, List, MatrixType, Several, VectorType
from ..judge.source import label
from ..judge.subset import analyse_kernel
from .functions import write_function
from .layout import CodeLines
from .names import C_TYPES, Names, block_type_name, c_type, comment, declaration, identifier, literal, names_of
from .records import write_records
from .tables import write_tables

FREXP = Several((FLOAT, INT))
C_ERRORS = {DOMAIN_ERROR: "DOMAIN_ERROR", RANGE_ERROR: "RANGE_ERROR"}

DECLARATIONS = {2: "block_elements.h", 3: "fmi3_variables.h"}  # by version of FMI

HEADER = """\
/* {name}: {summary}
 *
 * Translated from {file}; change that, not this. Numbers at the right
 * are lines of the Python file named above the function.
 *
 * Compile with -std=c99 -O2 -ffp-contract=off -fno-tree-vectorize and link with -lm: then every
 * result has the bits of the Python source. To link several FMUs into one program, define
 * FMI{fmi}_FUNCTION_PREFIX={name}_ for each.
 */
#include "{include}"
"""

FOOTER = """\
#include "fmi{fmi}_wrapper.h"
#include "single_block.h"
"""


def translate(block_class: type[Block], guid: str, fmi: int = 2) -> str:
    """Return the C source of a block for an FMU with this GUID; it includes the wrapper of FMI 2.0 or 3.0.

    Raises `SubsetError` if the block is outside the subset of Python.
    """
    header = HEADER.format(
        name=block_class.fmu_name,
        summary=comment(block_class.summary()),
        file=label(Path(inspect.getfile(block_class))),
        fmi=fmi,
        include=DECLARATIONS[fmi],
    )
    kernel, entry_points = _around_tables(block_class)  # type: ignore[arg-type]
    tables = write_tables(block_class, block_type_name(block_class.__name__), guid, fmi)
    return "\n".join((header, *kernel, tables, entry_points, FOOTER.format(fmi=fmi)))


def translate_functions(block_class: type[Block]) -> tuple[str, dict[str, str]]:
    """Return the C code of the functions that a block calls, without the block, and their C names by Python name.

    The functions are prefixed with the name of their Python file. Raises `SubsetError` like `translate`.
    """
    kernel = analyse_kernel(block_class)
    names = names_of(kernel)
    kernel.functions = [function for function in kernel.functions if not function.takes_block]
    text = "\n".join([*_constants(names), *_several(kernel), *_functions(kernel, names, "")])
    return text, {function.name: names.functions[function] for function in kernel.functions}


@cache  # an FMU is translated without and with its GUID, which is a hash of the former
def _around_tables(block_class: type[Block]) -> tuple[list[str], str]:
    """Return the C code before and after the tables, which contain the GUID: kernel and entry points."""
    kernel = analyse_kernel(block_class)
    names = names_of(kernel)
    type_name = block_type_name(block_class.__name__)
    before = [
        *_matrices(kernel),
        *write_records(kernel),
        _struct(block_class, type_name),
        *_constants(names),
        *_several(kernel),
        *_functions(kernel, names, type_name),
    ]
    return before, _entry_points(kernel, names)


def _matrices(kernel: Kernel) -> list[str]:
    """Return a struct for each size of matrix."""
    kinds = {type_of_variable(variable) for variable in kernel.block_class.variables.values()}
    for function in kernel.functions:
        kinds |= {*function.parameters.values(), *function.locals.values(), *function.types.values()}  # type: ignore[arg-type]
    lines = CodeLines()
    for kind in sorted({kind for kind in kinds if isinstance(kind, MatrixType)}, key=c_type):
        size = kind.rows * kind.columns
        lines.open(f"typedef struct {c_type(kind)} {{")
        lines.add(f"{C_TYPES[kind.element]} x[{size}];")
        lines.close(f"}} {c_type(kind)};")
        lines.text.append("")
    return ["\n".join(lines.text)] if lines.text else []


def _struct(block_class: type[Block], type_name: str) -> str:
    """Write the block's struct with one member per variable, commented by causality, unit, frame and description."""
    lines = CodeLines()
    lines.comment("Variables in order of declaration.")
    lines.open(f"typedef struct {type_name} {{")
    for name, variable in block_class.variables.items():
        kind = type_of_variable(variable)
        if isinstance(kind, List):
            text = f"{C_TYPES[kind.element]} {identifier(name)}[{kind.size}]"
        elif isinstance(kind, MatrixType):
            text = f"{c_type(kind)} {identifier(name)}"
        else:
            text = declaration(kind, identifier(name))
        lines.member(f"{text};", _about(variable))
    lines.close(f"}} {type_name};")
    return "\n".join([*lines.text, ""])


def _about(variable: Variable) -> str:
    kind = "state" if variable.causality == "local" else variable.causality
    unit = f", {variable.unit}" if variable.unit and variable.unit != "1" else ""
    frame = f" ({variable.frame} frame)" if variable.frame else ""
    return comment(f"{kind}{unit}: {variable.description}{frame}")


def _constants(names: Names) -> list[str]:
    """Return the module constants that the kernel uses; those of math are in kernel_math.h."""
    lines = CodeLines()
    for constant, name in sorted(names.constants.items(), key=lambda item: item[1]):
        if constant.module == "math":
            continue
        if isinstance(constant.value, vector_types.Vector):
            parts = ", ".join(map(literal, constant.value))
            lines.add(f"static const {c_type(VectorType(len(constant.value)))} {name} = {{{{{parts}}}}};")
            continue
        elements = constant.value if isinstance(constant.value, tuple) else (constant.value,)
        kind = C_TYPES[SCALARS[type(elements[0])]]
        if isinstance(constant.value, tuple):
            lines.add(f"static const {kind} {name}[{len(elements)}] = {{{', '.join(map(literal, elements))}}};")
        else:
            lines.add(f"static const {kind} {name} = {literal(constant.value)};")
    return ["\n".join([*lines.text, ""])] if lines.text else []


def _several(kernel: Kernel) -> list[str]:
    """Return a struct for each combination of types that functions return together."""
    kinds = {function.returns for function in kernel.functions if isinstance(function.returns, Several)}
    kinds.discard(FREXP)  # in kernel_math.h
    lines = CodeLines()
    for kind in sorted(kinds, key=c_type):
        lines.open(f"typedef struct {c_type(kind)} {{")
        for number, part in enumerate(kind.parts):
            lines.add(f"{c_type(part)} part{number};")
        lines.close(f"}} {c_type(kind)};")
        lines.text.append("")
    return ["\n".join(lines.text)] if lines.text else []


def _functions(kernel: Kernel, names: Names, type_name: str) -> list[str]:
    """Write every function, callees first, under the name of its Python file."""
    definitions = []
    file = ""
    for function in _by_file(kernel.functions):
        here = label(function.source.path)
        if here != file:
            undefine = "#undef AT\n" if file else ""
            definitions.append(f'/* ---- {here} ---- */\n\n{undefine}#define AT(line) fault, "{here}", line\n')
            file = here
        definitions.append("\n".join([*write_function(function, names, type_name), ""]))
        error = FAULTS.get(function.source.function)
        if error is not None:
            definitions.append(_define_checked(function, names.functions[function], error))
    return definitions


def _define_checked(function: Function, c_name: str, error: str) -> str:
    """Return the form of an elementary function, such as ``py_sin``, that records a fault at its caller's line."""
    if error == EITHER_ERROR:
        return f"CHECKED_POWER({function.source.name}, {c_name})\n"
    return f"CHECKED_FUNCTION({function.source.name}, {c_name}, {C_ERRORS[error]})\n"


def _by_file(functions: list[Function]) -> list[Function]:
    """Return functions with callees before callers, grouped by file where possible."""
    waiting = list(functions)
    ordered: list[Function] = []
    while waiting:
        ready = [function for function in waiting if not set(function.callees()) & set(waiting)]
        same_file = [function for function in ready if ordered and function.source.path == ordered[-1].source.path]
        ordered.append((same_file or ready)[0])
        waiting.remove(ordered[-1])
    return ordered


def _entry_points(kernel: Kernel, names: Names) -> str:
    assert kernel.initialize is not None
    assert kernel.step is not None
    lines = CodeLines()
    for function, c_name, extra in ((kernel.initialize, "model_initialize", ""), (kernel.step, "model_step", "t, h")):
        arguments = ", double t, double h" if extra else ""
        lines.open(f"static void {c_name}(Block *self, Fault *fault{arguments})\n{{")
        if not function.can_fault:
            lines.add("(void)fault;")
        passed = ["self", *(["fault"] if function.can_fault else []), *([extra] if extra else [])]
        lines.add(f"{names.functions[function]}({', '.join(passed)});")
        lines.close("}")
        lines.text.append("")
    sampled = SAMPLE_PERIOD in kernel.block_class.variables
    lines.comment("Time between samples (s); 0 where the block steps at every communication point.")
    lines.open("static double model_sample_period(const Block *self)\n{")
    if not sampled:
        lines.add("(void)self;")
    lines.add(f"return {f'self->{SAMPLE_PERIOD}' if sampled else '0.0'};")
    lines.close("}")
    lines.text.append("")
    name = integration_step(kernel.block_class)
    lines.comment("Longest step of the block's own integration (s); infinite where it has none.")
    lines.open("static double model_integration_step(const Block *self)\n{")
    if name is None:
        lines.add("(void)self;")
    lines.add(f"return {'INFINITY' if name is None else f'self->{name}'};")
    lines.close("}")
    lines.text.append("")
    lines.comment("Tell a block that has a state start_time when it starts (s).")
    lines.open("static void model_set_start_time(Block *self, double start_time)\n{")
    if START_TIME in kernel.block_class.variables:
        lines.add(f"self->{START_TIME} = start_time;")
    else:
        lines.add("(void)self, (void)start_time;")
    lines.close("}")
    return "\n".join([*lines.text, ""])
