"""C unit that connects the components of a system and steps them in the order of Perilune's sequential loop."""

from __future__ import annotations

from collections.abc import Sequence

from perilune.analysis.runtime.system.network import NodeLink
from perilune.analysis.runtime.system.prepared import PreparedSystem

from ..contestant import ExchangeSystem
from .fused_component import Part

FILE = "fused.c"

START = """\
/* {system}: its blocks, fused into one function without FMI.
 *
 * Compile with the units of the components, with the flags of their FMUs and with -flto.
 */
#include "kernel_vectors.h"

"""
FLY = """\
/* Fly from start (s). record takes the first and the last row of what others read.
 *
 * Returns what went wrong, or NULL.
 */
__attribute__((visibility("default")))
const char *fly(double start, double step, int64_t steps, double *record)
{{
    const char *what;
{initial}    write_row(record);
    for (int64_t n = 0; n < steps; n++) {{
        const double t = start + (double)n * step;
{step}    }}
    write_row(record + {width});
    return NULL;
}}
"""


def write_main(course: ExchangeSystem, parts: Sequence[Part]) -> str:
    """Return the C unit, whose function ``fly`` simulates the system and records `Course.names`."""
    return _Writer(course, parts).text()


class _Writer:
    def __init__(self, course: ExchangeSystem, parts: Sequence[Part]) -> None:
        self.course = course
        self.prepared: PreparedSystem = course.prepared
        self.parts = {part.component: part for part in parts}

    def text(self) -> str:
        names = self.course.names
        rows = [f"    row[{index}] = {self._member(name)};\n" for index, name in enumerate(names)]
        return "".join(
            [
                START.format(system=self.prepared.archive.name),
                *self._declarations(),
                f"static void write_row(double *row)\n{{\n{''.join(rows)}}}\n\n",
                FLY.format(initial=_indented(self._initial(), 1), step=_indented(self._step(), 2), width=len(names)),
            ]
        )

    def _declarations(self) -> list[str]:
        structs = [struct for part in self.parts.values() for struct in part.structs.values()]
        lines = [f"{struct}\n" for struct in dict.fromkeys(structs)]
        for part in self.parts.values():
            lines.append(f"extern {part.type_name} {part.instance};\n")
            lines.append(f"void {part.instance}_restart(double start_time);\n")
            lines.append(f"const char *{part.instance}_settle(void);\n")
            lines.append(f"const char *{part.instance}_step(double t, double h);\n\n")
        return lines

    def _initial(self) -> list[str]:
        """Return the statements that set parameters and exchange values once at the start.

        Components that step before their sources keep their start values.
        """
        schedule = self.prepared.schedule
        lines = [f"{part.instance}_restart(start);" for part in self.parts.values()]
        known: list[str] = []
        for component in schedule.initial_order:
            lines += self._set(component, known)
            lines.append(f"if ((what = {self.parts[component].instance}_settle()) != NULL) return what;")
            lines += self._check(component)
            known.append(component)
        return lines + [line for component in schedule.sources_first for line in self._set(component)]

    def _step(self) -> list[str]:
        schedule = self.prepared.schedule
        lines = [self._advance(component) for component in schedule.sources_first]
        for component in schedule.sources_first:
            lines += self._check(component)
        for component in schedule.followers:
            lines += [*self._set(component), self._advance(component), *self._check(component)]
        return lines + [line for component in schedule.sources_first for line in self._set(component)]

    def _set(self, component: str, known: Sequence[str] | None = None) -> list[str]:
        """Return the statements that set a component's inputs, with ``known`` only those from these components."""
        return [
            f"{self._member(link.target.name)} = {self._member(link.source.name)};"
            for link in self._links_to(component)
            if known is None or link.source.component in known
        ]

    def _advance(self, component: str) -> str:
        return f"if ((what = {self.parts[component].instance}_step(t, step)) != NULL) return what;"

    def _check(self, component: str) -> list[str]:
        """Return the statements that stop at a connected output that is NaN or infinite."""
        names = dict.fromkeys(
            link.source.name
            for link in self.prepared.network.driver.values()
            if link.source.component == component and link.source.type_name == "Real"
        )
        if not names:
            return []
        finite = ["bool finite = true;", *(f"finite &= isfinite({self._member(name)}) != 0;" for name in names)]
        return ["{", *finite, f'if (!finite) return "{component}: an output is not finite";', "}"]

    def _links_to(self, component: str) -> list[NodeLink]:
        return [link for link in self.course.links if link.target.component == component]

    def _member(self, name: str) -> str:
        node = self.prepared.network.nodes[name]
        part = self.parts[node.component or ""]
        return f"{part.instance}.{part.members[node.variable]}"


def _indented(lines: Sequence[str], depth: int) -> str:
    return "".join(f"{'    ' * depth}{line}\n" for line in lines)
