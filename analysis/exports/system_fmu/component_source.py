"""The C of a component's FMU as part of a system's: without the wrapper of FMI, its names with a prefix."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from ....fmus_src.export.native_fmu import read_wrapper
from ....fmus_src.export.write.translate import FOOTER
from ...common.errors import InputError
from ...runtime.fused.component_code import TOKEN
from ...runtime.system.fmu import Fmu

SHARED = ("kernel_math.h", "kernel_vectors.h", "block_elements.h")  # which all components of a system use
END = FOOTER.format(fmi=2)
# What a block's file defines begins in the first column.
STRUCT = re.compile(r"^typedef struct (\w+) \{", re.MULTILINE)
STATIC = re.compile(r"^static [\w *]*?(\w+)(?= ?[(\[=])", re.MULTILINE)
MACRO = re.compile(r"^#define (\w+)", re.MULTILINE)
CHECKED = re.compile(r"^(?:CHECKED_FUNCTION|CHECKED_POWER)\((\w+),", re.MULTILINE)  # defines py_NAME
TABLES = re.compile(
    r"^/\* In order of declaration. \*/\nstatic const Element.*?(?=^static void model_initialize)", re.M | re.S
)
ELEMENT = re.compile(r"\{offsetof\(Block, ([^)]+)\), (KIND_\w+) \| (ROLE_\w+), \d+\},")
GIVEN = ("ROLE_PARAMETER", "ROLE_TUNABLE", "ROLE_INPUT")
REMEDY = "build it again with this Perilune"


@dataclass(frozen=True)
class Member:
    """A variable of a block in its C struct: ``kind`` is KIND_REAL, KIND_INTEGER or KIND_BOOLEAN, ``role`` ROLE_INPUT,
    ROLE_OUTPUT, ROLE_PARAMETER, ROLE_TUNABLE or ROLE_STATE."""

    path: str
    kind: str
    role: str


@dataclass(frozen=True)
class ComponentSource:
    """``text`` is the C of an FMU's block, whose names begin with ``prefix``, and ``members`` its variables in order of
    value references."""

    prefix: str
    text: str
    members: tuple[Member, ...]

    @property
    def block(self) -> str:
        """The type of the block's struct."""
        return f"{self.prefix}Block"

    @property
    def type_name(self) -> str:
        """The type of a component: a block and the samples that it has taken."""
        return f"{self.prefix}Component"

    @property
    def given(self) -> dict[str, bool]:
        """The struct's members, whole, that are parameters and inputs, and whether they are arrays of C."""
        given = [each.path for each in self.members if each.role in GIVEN]
        return {re.split(r"[.\[]", path)[0]: re.match(r"\w+\[", path) is not None for path in given}


def read_component_source(fmu: Fmu, name: str) -> ComponentSource:
    """The source of an FMU of ours, whose names begin with ``name``. Raises InputError for the C of another build."""
    sources = fmu.read_sources()
    main = sources.get(f"{fmu.description.coSimulation.modelIdentifier}.c", "")
    if "system_steps.h" in sources:
        problem = "is itself a system as one FMU"
        raise InputError(fmu.label, "sources", problem, "nest the system in its place, or export this one as .ssp")
    ours = read_wrapper(2)
    known = all(sources.get(header, "").encode() == ours[header] for header in SHARED)
    tables = TABLES.search(main)
    if not (main.endswith(END) and known and tables):
        raise InputError(fmu.label, "sources", "its C is of another build of Perilune", REMEDY)
    members = tuple(Member(*match.groups()) for match in ELEMENT.finditer(main))
    if len(members) != len(fmu.variables):
        problem = f"its C has {len(members)} variables, its modelDescription.xml {len(fmu.variables)}"
        raise InputError(fmu.label, "sources", problem, REMEDY)
    text = main.replace(tables[0], "").removesuffix(END)
    return ComponentSource(f"{name}_", rename(text, f"{name}_"), members)


def rename(text: str, prefix: str) -> str:
    """The text of a block's file, all names that it defines with a prefix; comments and strings as they are."""
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
