"""C code of one component inside a larger translation unit: headers included, names prefixed."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from ....common.errors import InputError

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*("([^"]+)"|<[^>]+>)[ \t]*$', re.MULTILINE)
TOKEN = re.compile(
    r"""(?P<comment>/\*.*?\*/|//[^\n]*)"""
    r"""|(?P<text>"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')"""
    r"""|(?P<number>\.?\d(?:[eEpP][+-]|[\w.])*)"""
    r"""|(?P<name>[A-Za-z_]\w*)""",
    re.DOTALL,
)
MACRO = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)", re.MULTILINE)
JOINED = re.compile(r"(\w+)##")  # prefix to which a macro joins its argument, forming a name
USE = re.compile(r"^[A-Z_]+\((\w+)", re.MULTILINE)  # first argument of a macro, joined to that prefix
RESERVED = re.compile(r"_[_A-Z]")
WRAPPER = '#include "fmi2_wrapper.h"'
INSTEAD = {"fmi2Functions.h": "fmi2FunctionTypes.h"}  # types without functions, which the unit does not contain
NEEDED = '#include "fmi2_types.h"\n#include "life_cycle.h"'  # replaces the wrapper: an instance and its steps

OFFSETS = """
/* The offset of a variable in an instance, by its value reference. */
_UNIT_EXPORT uint32_t offset_of(uint32_t reference)
{
    return (uint32_t)offsetof(Component, now.block) + ELEMENTS[reference].offset;
}
"""

# Names of C and its library, which must not be prefixed. If one is missing here, the compiler rejects the code.
STANDARD = frozenset(
    re.findall(
        r"\w+",
        """
        auto break case char const continue default do double else enum extern float for goto if inline int long
        register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
        define undef ifdef ifndef elif endif defined error pragma
        size_t ptrdiff_t bool true false NULL int8_t uint8_t int16_t uint16_t int32_t uint32_t int64_t uint64_t
        uintptr_t INT32_MIN INT32_MAX INT64_MIN INT64_MAX UINT32_MAX UINT64_MAX UINT64_C INT64_C SIZE_MAX
        INFINITY NAN HUGE_VAL FLT_EVAL_METHOD offsetof PRId64 va_list va_start va_arg va_end snprintf vsnprintf sprintf
        abs atoi strtod calloc malloc free memcpy memmove memset memcmp strchr strcmp strcpy strlen strspn strstr
        fmod fabs sqrt floor ceil trunc isfinite isnan isinf signbit copysign
        pack push pop cold noinline always_inline visibility dllexport
        """,
    )
)


@dataclass(frozen=True)
class ComponentCode:
    """C ``text`` with names that get a ``prefix`` when compiled, and the standard ``headers`` that it needs."""

    prefix: str
    text: str
    headers: frozenset[str]


def component_code(sources: Mapping[str, str], model: str, prefix: str, label: str) -> ComponentCode:
    """Return the C code of one of Perilune's native FMUs without the FMI functions; ``sources`` are by file name.

    ``model`` is the FMU's model identifier. Raises InputError, which names ``label``, if the code is from another
    version of Perilune.
    """
    main = sources.get(f"{model}.c", "")
    if WRAPPER not in main:
        problem = "its C code does not have the interface that fused steps need"
        raise InputError(
            label, "sources", problem, "export the FMU again with this version of Perilune, or give `flavour` native"
        )
    headers: set[str] = set()
    text = _include(main.replace(WRAPPER, NEEDED) + OFFSETS, sources, label, headers, set())
    return ComponentCode(prefix, _rename(text, prefix), frozenset(headers))


def _include(text: str, sources: Mapping[str, str], label: str, headers: set[str], included: set[str]) -> str:
    """Return the text with each header of the FMU inserted once; collect standard headers in ``headers``."""

    def put(include: re.Match[str]) -> str:
        file = INSTEAD.get(include[2], include[2])
        if file is None:
            headers.add(include[1])
            return ""
        if file in included:
            return ""
        included.add(file)
        if file not in sources:
            raise InputError(label, f"sources/{file}", "is missing", "export the FMU again")
        return _include(sources[file], sources, label, headers, included)

    return INCLUDE.sub(put, text)


def _rename(text: str, prefix: str) -> str:
    """Return the text between lines that define, and undefine, a macro with the prefixed name for each of its names.

    The preprocessor renames, because the C code also joins names (``py_##name``). Macros that the text defines are
    undefined, too.
    """
    names = {token["name"] for token in TOKEN.finditer(text) if token["name"]}
    names |= {first + second for first in JOINED.findall(text) for second in USE.findall(text)}
    macros = set(MACRO.findall(text))
    ours = sorted(name for name in names - macros - STANDARD if not RESERVED.match(name))
    return "\n".join(
        [
            *(f"#define {name} {prefix}{name}" for name in ours),
            text,
            *(f"#undef {name}" for name in sorted({*ours, *macros})),
            "",
        ]
    )
