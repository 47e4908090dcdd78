"""The page of a block: purpose and source from its docstring, all else from its declaration."""

from __future__ import annotations

from pathlib import Path

from perilune.analysis.authoring.fits import Demand, blocks_of_slot, connectors_of, slots
from perilune.fmus_src.block import Block, Output, Parameter
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.roles import SAMPLE_PERIOD

from .markdown import prose, table
from .unread import explain_unread
from .usage import Usage, usages
from .variables import declared, inputs, outputs, parameters, states


def block_page(block: type[Block]) -> str:
    """Return Markdown of one block, to lie in reference/blocks."""
    parts = [
        f"# {block.fmu_name}",
        prose(block.__doc__, "../../"),
        table(["", ""], _facts(block)),
        _section("Inputs", inputs(block)),
        _section("Outputs", outputs(block)),
        _section("Parameters", "\n\n".join(filter(None, (parameters(block), explain_unread(block))))),
        _section("States", states(block)),
        _section("In its place", _place(block)),
        _section("What it shares", _shared(block)),
        _section("Where it flies", _flown(usages().get(block.fmu_name, Usage()))),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def slots_of(block: type[Block]) -> list[type[Block]]:
    """Return the slots of a block, the nearest first."""
    known = set(slots().values())
    return [base for base in block.__mro__[1:] if base in known]


def source_of(block: type[Block]) -> str:
    """Return the file that defines a block, below the package."""
    return Path(*block.__module__.split(".")[1:]).with_suffix(".py").as_posix()


def fitting(block: type[Block]) -> list[str]:
    """Return other blocks of the catalogue that have all its inputs and outputs."""
    wanted = _connectors(block)
    return [name for name, other in catalogue().items() if other is not block and wanted <= _connectors(other)]


def _connectors(block: type[Block]) -> set[Demand]:
    return {entry for entry in connectors_of(block) if entry[1] in ("input", "output")}


def _facts(block: type[Block]) -> list[list[str]]:
    parents = [other for other in catalogue().values() if other is not block and issubclass(block, other)]
    standing = ", ".join(f"[{slot.fmu_name}](../slots.md#{slot.fmu_name})" for slot in slots_of(block))
    facts = [
        ["class", f"`{block.__name__}` in `{source_of(block)}`"],
        ["slot", standing or "none: no other block has its connectors by declaration"],
        ["flavours", f"Python only, with {', '.join(block.requires)}" if block.python_only else "native and Python"],
        ["acts", _rate(block)],
        ["proposes a communication step of", f"{block.default_step:g} s"],
        ["answers within a communication point", _feedthrough(block)],
    ]
    if parents:
        facts.insert(1, ["variant of", f"[{parents[0].fmu_name}]({parents[0].fmu_name}.md), which says more"])
    return facts


def _rate(block: type[Block]) -> str:
    period = block.variables.get(SAMPLE_PERIOD)
    if not isinstance(period, Parameter):
        return "at every communication point"
    value = period.elements[0]
    return f"every `sample_period`; by default {f'{value:g} s' if value else 'at every communication point'}"


def _feedthrough(block: type[Block]) -> str:
    every = declared(block, Output)
    direct = [variable for variable in every if isinstance(variable, Output) and block.direct_inputs(variable)]
    if not direct:
        return "no: outputs depend on inputs of earlier points only"
    return f"yes: {'all' if len(direct) == len(every) else 'some'} of its outputs depend on inputs of the same point"


def _shared(block: type[Block]) -> str:
    """Return the docstrings of a block's slots, and of the block that it is a variant of."""
    bases: list[type[Block]] = [base for base in block.__mro__[1:] if issubclass(base, Block) and base is not Block]
    return "\n\n".join(f"### {base.fmu_name}\n\n{prose(base.__doc__, '../../')}" for base in bases)


def _place(block: type[Block]) -> str:
    own = slots_of(block)
    others = fitting(block)
    lines = []
    if own:
        siblings = [other.fmu_name for other in blocks_of_slot(own[-1]) if other is not block]
        others = [name for name in others if name not in siblings]
        said = f"In its slot, [{own[-1].fmu_name}](../slots.md#{own[-1].fmu_name})"
        lines.append(f"{said}: {_linked(siblings)}." if siblings else f"{said}, it is the only one.")
    if others:
        lines.append(f"With all its connectors: {_linked(others)}.")
    return "\n\n".join(lines) or "No other FMU of this repository has all its connectors."


def _linked(names: list[str]) -> str:
    return ", ".join(f"[{name}]({name}.md)" for name in names)


def _flown(usage: Usage) -> str:
    rows = [
        [f"[{system}](../../systems/{system}.md)", _quoted(usage.components, system), _quoted(usage.campaigns, system)]
        for system in sorted({*usage.components, *usage.campaigns})
    ]
    if not rows:
        return "In no system as it stands; `--use SLOT=FMU` puts it where it fits."
    return table(["system", "as the component", "as a variant of the campaigns"], rows)


def _quoted(names: dict[str, list[str]], system: str) -> str:
    return ", ".join(f"`{name}`" for name in names.get(system, []))


def _section(title: str, content: str) -> str:
    return f"## {title}\n\n{content}" if content else ""
