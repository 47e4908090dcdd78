"""Translation unit of a system's steps: the code of its FMUs, and a statement for each instruction of the loop."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from importlib.resources import files

from ..loop import arrays, codes
from ..loop.structures import read_header
from .component_code import ComponentCode
from .statements import INSTANCE_POINTER, Instruction, Statements

ENTRY = "perilune_fly_steps"
SELF_TEST = "perilune_check_arithmetic"
EXPORT = """\
#if defined(_WIN32)
#define _UNIT_EXPORT __declspec(dllexport)
#else
#define _UNIT_EXPORT __attribute__((visibility("default")))
#endif
"""
CHECK = """\
/* What is wrong with the arithmetic of the compiled unit; NULL: nothing. */
_UNIT_EXPORT const char *{name}(void)
{{
    return {prefix}check_arithmetic();
}}
"""
FLY = """\
/* Fly from communication point to communication point; returns the number of rows in the record. */
_UNIT_EXPORT int64_t {entry}(const Run *run, int64_t point, int64_t rows, int64_t to_record)
{{
    PARTS_OF(run);
{instances}
    int status = 0;
    for (;;) {{
        const double time = start + (double)point * step;
        const double after = start + (double)(point + 1) * step;
        outcome[4] = point + 1;
        switch (point % {phases}) {{
{cases}
        }}
        point += 1;
        const int has_finished = {finished};
        const int has_halted = halt[0] != 0;
        const int is_last = has_finished || has_halted || point == last_point;
        if (is_last || to_record == 0) {{
            to_record = stride;
            times[rows] = after;
{recorded}
            rows += 1;
        }}
        to_record -= 1;
        if (is_last) {{
            outcome[0] = has_finished ? FINISHED : point == last_point ? STOP_TIME : INTERRUPTED;
            return rows;
        }}
        (void)time, (void)status;
    }}
}}
"""


def write_unit(program: arrays.Program, recorded: Iterable[int], components: Mapping[int, ComponentCode]) -> str:
    """Return the translation unit of a ``program`` that records these slots, with the code of components by number."""
    kinds = {code.prefix: code for code in components.values()}
    headers = {"<math.h>", "<stdint.h>", "<string.h>", *(header for kind in kinds.values() for header in kind.headers)}
    statements = Statements(program, {component: code.prefix for component, code in components.items()})
    phases = program.phases.tolist()
    cases = []
    for phase, (first, end) in enumerate(itertools.pairwise(phases)):
        rows = [Instruction(number, *row) for number, row in enumerate(program.instructions[first:end].tolist(), first)]
        lines = [line for row in rows for line in statements.of(row)]
        cases.append(
            "\n".join([f"        case {phase}:", *(f"            {line}" for line in lines), "            break;"])
        )
    fly = FLY.format(
        entry=ENTRY,
        instances="\n".join(_instances(program, components)),
        phases=len(phases) - 1,
        cases="\n".join(cases),
        finished=f"values[{program.finished_slot}] != 0.0" if program.finished_slot >= 0 else "0",
        recorded="\n".join(
            f"            record[{column} * capacity + rows] = values[{slot}];" for column, slot in enumerate(recorded)
        ),
    )
    return "\n".join(
        [
            *(f"#include {header}" for header in sorted(headers)),
            EXPORT,
            *(kind.text for kind in kinds.values()),
            read_header("run.h"),
            read_header("floats.h"),
            files(__package__).joinpath("outcomes.h").read_text(),
            CHECK.format(name=SELF_TEST, prefix=next(iter(kinds))),
            fly,
        ]
    )


def _instances(program: arrays.Program, components: Mapping[int, ComponentCode]) -> list[str]:
    """Return declarations of the instances that instructions use, typed if the component's code is in the unit."""
    first: dict[int, int] = {}
    for number, row in enumerate(program.instructions.tolist()):
        if row[codes.INSTANCE]:
            first.setdefault(row[codes.COMPONENT], number * codes.COLUMNS + codes.INSTANCE)
    lines = []
    for component, index in first.items():
        kind = f"{components[component].prefix}Component" if component in components else "void"
        pointer = INSTANCE_POINTER.format(component)
        lines.append(f"    {kind} *const {pointer} = ({kind} *)(uintptr_t)instructions[{index}];")
        lines.append(f"    (void){pointer};")
    return lines
