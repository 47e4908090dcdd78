"""Documentation inside a system's FMU: documentation/index.html, and the README of its sources."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from lxml import etree
from lxml.html import builder

from ....fmus_src.evidence.page import page_of
from .fmu_variables import FmuVariable
from .model import SystemModel
from .parameter_sets import ConvertedSets

PAGE = "documentation/index.html"
README = "sources/README.md"
TITLES = (("input", "Inputs"), ("output", "Outputs"), ("local", "Exposed signals"), ("parameter", "Parameters"))
TEXT = """\
# {name}

{about}

Compile the library of this FMU for another platform in this folder with

    gcc -std=c99 -O2 -ffp-contract=off -fno-tree-vectorize -fPIC -shared -o {name}.so {name}.c -lm

and put it into `binaries/PLATFORM/`. With these flags results have the same bits everywhere; others are noticed when
the FMU is instantiated. `{name}.c` has the steps of the system and includes the other files: a header for each kind of
component, with the C that its block was translated into, and the wrapper of FMI 2.0.
"""


def system_readme(name: str, about: str) -> str:
    """Return the README, with instructions to compile the sources."""
    return TEXT.format(name=name, about=about)


def system_page(
    name: str,
    about: str,
    model: SystemModel,
    declared: Sequence[FmuVariable],
    dependencies: Mapping[str, Sequence[str]],
    others: ConvertedSets,
) -> bytes:
    """Return the HTML page about the system's components, simulation and variables."""
    body = [builder.H1(name), builder.P(about), builder.H2("Components")]
    body.append(
        _table(["component", "block"], [[candidate.label, candidate.fmu.name] for candidate in model.candidates])
    )
    body += [builder.H2("Simulation"), *map(builder.P, _conditions(model, dependencies))]
    if others.files:
        sets = ", ".join(file.removeprefix("resources/") for file in others.files)
        body.append(builder.P(f"resources/ has parameter sets of the system that are not applied: {sets}."))
    if others.unfit:
        body.append(builder.P(f"Omitted, since they do not fit: {'; '.join(others.unfit)}."))
    for causality, title in TITLES:
        variables = [each for each in declared if each.causality == causality]
        if variables:
            body += [builder.H2(title), _table(["name", "type", "start", "unit", "description"], map(_row, variables))]
    return page_of(name, body)


def _conditions(model: SystemModel, dependencies: Mapping[str, Sequence[str]]) -> list[str]:
    step = model.first.step
    texts = [
        f"A communication step must be a whole multiple of {step:g} s, the step of the system; inputs are held "
        "constant during it. Other steps are refused.",
        "Once the system has ended, all values stay constant, and fmi2GetBooleanStatus(fmi2Terminated) is true.",
        "The complete state can be saved, restored and serialised. Instances are independent of one another.",
    ]
    if dependencies:
        pairs = "; ".join(f"{output} on {', '.join(inputs)}" for output, inputs in dependencies.items())
        texts.append(
            f"Outputs depend directly on inputs: {pairs}. As a component of another system, the whole FMU is "
            "therefore stepped with inputs from the end of the step. If the original system is nested there "
            "instead, its components without direct dependence receive inputs from the start of the step: "
            "results differ by the change of these inputs over one step."
        )
    return texts


def _row(variable: FmuVariable) -> list[str]:
    start = "" if variable.start is None else str(variable.start)
    if variable.enumeration is not None and variable.start is not None:
        start = next((member.name for member in variable.enumeration.members if member.number == variable.start), start)
    return [variable.name, variable.type, start, variable.unit or "", variable.description]


def _table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> etree._Element:
    lines = [builder.TR(*map(builder.TH, header)), *(builder.TR(*map(builder.TD, row)) for row in rows)]
    return builder.TABLE(*lines)
