"""C source of a component type, derived from the C source of its FMU.

The FMI wrapper is removed, all names get a prefix, and functions are added that initialise and step the component.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from ....common.errors import InputError
from ....fmus_src.export.native_fmu import read_wrapper
from ....fmus_src.export.write.translate import FOOTER
from ...runtime.fused.component_code import TOKEN
from ...runtime.system.fmu import Fmu

SHARED = ("kernel_math.h", "kernel_vectors.h", "block_elements.h")  # shared by all components of a system
END = FOOTER.format(fmi=2)
# Definitions in a block's file start in the first column.
STRUCT = re.compile(r"^typedef struct (\w+) \{", re.MULTILINE)
STATIC = re.compile(r"^static [\w *]*?(\w+)(?= ?[(\[=])", re.MULTILINE)
MACRO = re.compile(r"^#define (\w+)", re.MULTILINE)
CHECKED = re.compile(r"^(?:CHECKED_FUNCTION|CHECKED_POWER)\((\w+),", re.MULTILINE)  # defines py_NAME
TABLES = re.compile(
    r"^/\* In order of declaration. \*/\nstatic const Element.*?(?=^static void model_initialize)", re.M | re.S
)
ELEMENT = re.compile(r"\{offsetof\(Block, ([^)]+)\), (KIND_\w+) \| (ROLE_\w+), \d+\},")
RETAINED_ROLES = ("ROLE_PARAMETER", "ROLE_TUNABLE", "ROLE_INPUT")
REMEDY = "build the FMU again with this version of Perilune"
FILE = """\
/* The block {name} as a component of a system: translated, as the file says below, with a prefix before its names. */
#ifndef {guard}
#define {guard}

{text}
typedef struct {type} {{
    {block} block;
    int64_t tick; /* samples taken since the start */
}} {type};

/* From parameters and inputs to states and outputs. */
static void {prefix}initialize({type} *self, Fault *fault, double start_time)
{{
{given}
    self->tick = 0;
    {prefix}model_set_start_time(&self->block, start_time);
    {prefix}model_initialize(&self->block, fault);
}}

/* Advance from t to t + h; a sampled block steps at its sample instants only. */
static void {prefix}advance({type} *self, Fault *fault, double start_time, double t, double h)
{{
    const double period = {prefix}model_sample_period(&self->block);
    switch (count_samples(&self->tick, start_time, period, t + h)) {{
        case NO_SAMPLE: return;
        case ONE_SAMPLE: break;
        case SEVERAL_SAMPLES:
            fault->what = "StepError: the step holds more than one sample of its sample_period; use a longer period";
            return;
    }}
    if (h > STEP_LIMIT * {prefix}model_integration_step(&self->block)) {{
        fault->what = "StepError: the step holds more than a million integration steps; use a longer internal_step";
        return;
    }}
    {prefix}model_step(&self->block, fault, t, h);
}}

#endif
"""


@dataclass(frozen=True)
class StructMember:
    """A variable of a block in its C struct.

    ``kind`` is KIND_REAL, KIND_INTEGER or KIND_BOOLEAN; ``role`` is ROLE_INPUT, ROLE_OUTPUT, ROLE_PARAMETER,
    ROLE_TUNABLE or ROLE_STATE.
    """

    path: str
    kind: str
    role: str


@dataclass(frozen=True)
class BlockCode:
    """C code of a block: its source ``text``, in which all names begin with ``prefix``.

    ``members`` are the variables of the block in the order of value references.
    """

    prefix: str
    text: str
    members: tuple[StructMember, ...]

    @property
    def block(self) -> str:
        """The C type of the block's struct."""
        return f"{self.prefix}Block"

    @property
    def type_name(self) -> str:
        """The C type of a component: a block with its number of samples taken so far."""
        return f"{self.prefix}Component"

    @property
    def parameters_and_inputs(self) -> dict[str, bool]:
        """The members of the block's struct that contain parameters and inputs; the value is True for arrays."""
        paths = [each.path for each in self.members if each.role in RETAINED_ROLES]
        return {re.split(r"[.\[]", path)[0]: re.match(r"\w+\[", path) is not None for path in paths}


def read_component_source(fmu: Fmu, name: str) -> BlockCode:
    """Read the C source of one of Perilune's FMUs, and prefix its names with ``name``_.

    Raises InputError for a source from another build.
    """
    sources = fmu.read_sources()
    main = sources.get(f"{fmu.description.coSimulation.modelIdentifier}.c", "")
    if "system_steps.h" in sources:
        problem = "is itself a system as one FMU"
        raise InputError(fmu.label, "sources", problem, "nest its system here instead, or export this system as .ssp")
    ours = read_wrapper(2)
    known = all(sources.get(header, "").encode() == ours[header] for header in SHARED)
    tables = TABLES.search(main)
    if not (main.endswith(END) and known and tables):
        raise InputError(fmu.label, "sources", "its C source is from another version of Perilune", REMEDY)
    members = tuple(StructMember(*match.groups()) for match in ELEMENT.finditer(main))
    if len(members) != len(fmu.variables):
        problem = f"its C source has {len(members)} variables, but its modelDescription.xml has {len(fmu.variables)}"
        raise InputError(fmu.label, "sources", problem, REMEDY)
    text = main.replace(tables[0], "").removesuffix(END)
    return BlockCode(f"{name}_", rename(text, f"{name}_"), members)


def rename(text: str, prefix: str) -> str:
    """Return a block's source with a prefix on all names that it defines, except in comments and strings."""
    defined = {name for pattern in (STRUCT, STATIC, MACRO) for name in pattern.findall(text)} | {"Block"}
    checked = set(CHECKED.findall(text))
    names: Mapping[str, str] = {
        **{name: f"{prefix}{name}" for name in defined},
        **{f"py_{name}": f"py_{prefix}{name}" for name in checked},
    }

    def put(token: re.Match[str]) -> str:
        return names.get(token["name"] or "", token[0])

    renamed = TOKEN.sub(put, text)
    return re.sub(r"^(CHECKED_FUNCTION|CHECKED_POWER)\((\w+),", rf"\1({prefix}\2,", renamed, flags=re.MULTILINE)


def write_component_header(source: BlockCode) -> str:
    """Return the header of a component type, which is included in the system's source."""
    name = source.prefix.removesuffix("_")
    return FILE.format(
        name=name,
        guard=f"{name.upper()}_H",
        text=source.text.rstrip("\n") + "\n",
        type=source.type_name,
        block=source.block,
        prefix=source.prefix,
        given="\n".join(f"    {line}" for line in _restore_starts(source)),
    )


def _restore_starts(source: BlockCode) -> list[str]:
    """Return the statements that restore a block's start values, except for its parameters and inputs."""
    retained = [_retain(member, is_array) for member, is_array in source.parameters_and_inputs.items()]
    begin = f"self->block = {source.prefix}STARTS;"
    return [f"const {source.block} given = self->block;", begin, *retained] if retained else [begin]


def _retain(member: str, is_array: bool) -> str:
    if is_array:
        return f"memcpy(self->block.{member}, given.{member}, sizeof given.{member});"
    return f"self->block.{member} = given.{member};"


def file_name(source: BlockCode) -> str:
    """Return the file name of a component type's header."""
    return f"{source.prefix.removesuffix('_')}.h"
