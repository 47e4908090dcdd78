"""One component of a system as a C unit without FMI: kernel, instance, life cycle."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from perilune.analysis.runtime.ssp.parameter_sets import ParameterValue
from perilune.analysis.runtime.system.fmu import Fmu
from perilune.fmus_src.block import Block, Output, State
from perilune.fmus_src.export.native_fmu import native_guid
from perilune.fmus_src.export.write.names import literal, member
from perilune.fmus_src.export.write.translate import FOOTER, translate

from ..contestant import Unavailable

WRAPPER = FOOTER.format(fmi=2)
BLOCK = re.compile(r"^typedef (\w+) Block;", re.MULTILINE)
STRUCT = re.compile(r"^typedef struct (\w+) \{\n.*?^\} \1;\n", re.DOTALL | re.MULTILINE)

# Functions of instance.h for one instance, without checks of the importer.
LIFE_CYCLE = """\
/* ---- without FMI: one instance ---- */

{type} {instance};
static double start;
static int64_t tick; /* samples taken since the start */

/* Declared starts and the system's parameters. */
void {instance}_restart(double start_time)
{{
    {instance} = STARTS;
    start = start_time;
{parameters}}}

/* Run initialize from the declared starts of states and outputs. Returns what went wrong, or NULL. */
const char *{instance}_settle(void)
{{
{starts}    tick = 0;
    model_set_start_time(&{instance}, start);
    Fault fault = NO_FAULT;
    model_initialize(&{instance}, &fault);
    return fault.what;
}}

/* Advance from t to t + h; a sampled block steps at its sample instants only. */
const char *{instance}_step(double t, double h)
{{
    const double period = model_sample_period(&{instance});
    if (period > 0.0) {{
        const double margin = SAMPLE_TOLERANCE * period + TIME_TOLERANCE * fabs(t + h);
        const double due = start + (double)(tick + 1) * period;
        if (t + h < due - margin) return NULL;
        if (t + h >= due + period - margin) return "StepError: communication step holds more than one sample";
        tick += 1;
    }}
    Fault fault = NO_FAULT;
    model_step(&{instance}, &fault, t, h);
    return fault.what;
}}
"""


@dataclass(frozen=True)
class Part:
    """A component in C: ``instance`` is the name of its struct, ``members`` map variables to its members.

    ``structs`` are the structs of the members' types, by name.
    """

    component: str
    instance: str
    type_name: str
    structs: Mapping[str, str]
    members: Mapping[str, str]
    unit: str

    @property
    def file(self) -> str:
        return f"{self.instance}.c"


def write_part(
    component: str, number: int, fmu: Fmu, blocks: Mapping[str, type[Block]], parameters: Mapping[str, ParameterValue]
) -> Part:
    """Return the C unit of component ``number``. Raises `Unavailable` if its FMU is not among ``blocks``."""
    if fmu.name not in blocks:
        raise Unavailable(f"{component}: its FMU {fmu.name} is no block of the catalogue")
    block_class = blocks[fmu.name]
    _check_sources(component, fmu, block_class)
    text = translate(block_class, fmu.description.guid)
    block = BLOCK.search(text)
    assert block is not None
    structs = {struct[1]: struct[0] for struct in STRUCT.finditer(text)}
    needed = list(structs)[: list(structs).index(block[1]) + 1]  # matrices and records come first
    assert text.endswith(WRAPPER)
    instance = f"c{number}_{re.sub(r'[^0-9A-Za-z_]', '_', component)}"
    members = {element: member for elements in _members(block_class).values() for element, member in elements.items()}
    life_cycle = LIFE_CYCLE.format(
        type=block[1],
        instance=instance,
        parameters="".join(
            f"    {instance}.{members[name]} = {literal(value)};\n"  # type: ignore[arg-type]
            for name, value in parameters.items()
        ),
        starts="".join(
            f"    {instance}.{member} = STARTS.{member};\n"
            for variable, elements in _members(block_class).items()
            for member in elements.values()
            if isinstance(block_class.variables[variable], State | Output)
        ),
    )
    return Part(
        component,
        instance,
        block[1],
        {each: structs[each] for each in needed},
        members,
        text.removesuffix(WRAPPER) + life_cycle,
    )


def _check_sources(component: str, fmu: Fmu, block_class: type[Block]) -> None:
    """Reject a native FMU compiled from outdated sources, which is a different program. Raises `Unavailable`."""
    if fmu.is_native and fmu.description.guid != native_guid(block_class):
        raise Unavailable(f"{component}: its FMU {fmu.name} is of other sources; run build_fmus.py")


def _members(block_class: type[Block]) -> dict[str, dict[str, str]]:
    """Return the struct member of each FMI variable: ``position[1]`` is ``position.x[0]``."""
    members: dict[str, dict[str, str]] = {}
    for name, variable in block_class.variables.items():
        places = [member(variable, index) for index in range(variable.size)]
        members[name] = dict(zip(variable.element_names(), places, strict=True))
    return members
