"""Page of a block: model and literature from its docstring, all else from its declaration and its check."""

from __future__ import annotations

import inspect
from pathlib import Path

from perilune.analysis.authoring.fits import Demand, blocks_of_slot, connectors_of, slots
from perilune.fmus_src.block import Block, Output, Parameter
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.roles import SAMPLE_PERIOD

from .checks import check_section
from .markdown import table
from .markup.docstrings import ASSUMPTIONS, FRAMES, SOURCES, Description, describe_class
from .unread import explain_unread
from .usage import Usage, usages
from .variables import declared, enumerations, inputs, outputs, parameters, states

ROOT = "../../"  # from reference/blocks to the site's top


def block_page(block: type[Block]) -> str:
    """Return the Markdown page of one block, for reference/blocks."""
    described = {each: describe_class(each, ROOT) for each in (block, *bases_of(block))}
    sections = [
        f"# {block.fmu_name}",
        described[block].summary,
        table(["", ""], _facts(block)),
        _section("Model", _model(described)),
        *(_section(title, _gathered(described, title)) for title in (ASSUMPTIONS, FRAMES)),
        _section("Inputs", inputs(block)),
        _section("Outputs", outputs(block)),
        _section("Statuses and modes", enumerations(block)),
        _section("Parameters", "\n\n".join(filter(None, (parameters(block), explain_unread(block))))),
        _section("States", states(block)),
        _section("Check", check_section(block)),
        _section(SOURCES, _gathered(described, SOURCES)),
        _section("Code", _code(block)),
        _section("Interchangeable blocks", _place(block)),
        _section("Systems", _flown(usages().get(block.fmu_name, Usage()))),
    ]
    return "\n\n".join(section for section in sections if section) + "\n"


def bases_of(block: type[Block]) -> list[type[Block]]:
    """Return the base classes of a block that are blocks or interfaces, nearest first."""
    return [base for base in block.__mro__[1:] if issubclass(base, Block) and base is not Block]


def slots_of(block: type[Block]) -> list[type[Block]]:
    """Return the slots that a block fits, nearest base class first."""
    known = set(slots().values())
    return [base for base in block.__mro__[1:] if base in known]


def source_of(block: type[Block]) -> str:
    """Return the path, within the package, of the file that defines a block."""
    return Path(*block.__module__.split(".")[1:]).with_suffix(".py").as_posix()


def fitting(block: type[Block]) -> list[str]:
    """Return the other blocks of the catalogue that have all inputs and outputs of a block."""
    wanted = _connectors(block)
    return [name for name, other in catalogue().items() if other is not block and wanted <= _connectors(other)]


def _connectors(block: type[Block]) -> set[Demand]:
    return {entry for entry in connectors_of(block) if entry[1] in ("input", "output")}


def _facts(block: type[Block]) -> list[list[str]]:
    parents = [other for other in catalogue().values() if other is not block and issubclass(block, other)]
    standing = ", ".join(f"[{slot.fmu_name}](../slots.md#{slot.fmu_name})" for slot in slots_of(block))
    facts = [
        ["class", f"`{block.__name__}` in `{source_of(block)}`"],
        ["slot", standing or "none"],
        ["FMUs", f"Python only, with {', '.join(block.requires)}" if block.python_only else "native and Python"],
        ["samples", _rate(block)],
        ["default communication step", f"{block.default_step:g} s"],
        ["direct feedthrough", _feedthrough(block)],
    ]
    if parents:
        facts.insert(1, ["variant of", f"[{parents[0].fmu_name}]({parents[0].fmu_name}.md)"])
    return facts


def _rate(block: type[Block]) -> str:
    period = block.variables.get(SAMPLE_PERIOD)
    if not isinstance(period, Parameter):
        return "at every communication point"
    value = period.elements[0]
    return f"every `sample_period`; default: {f'{value:g} s' if value else 'every communication point'}"


def _feedthrough(block: type[Block]) -> str:
    every = declared(block, Output)
    direct = [variable for variable in every if isinstance(variable, Output) and block.direct_inputs(variable)]
    if not direct:
        return "none: outputs depend on inputs of earlier communication points only"
    return f"{'all' if len(direct) == len(every) else 'some'} outputs depend on inputs of the same communication point"


def _model(described: dict[type[Block], Description]) -> str:
    """Return the model of a block, followed by the models of its bases under separate headings."""
    paragraphs = []
    for index, (each, description) in enumerate(described.items()):
        if index and description.model:
            paragraphs.append(f"### Common to {each.fmu_name}")
        paragraphs += description.model
    return "\n\n".join(paragraphs)


def _gathered(described: dict[type[Block], Description], part: str) -> str:
    """Return a labelled section of a block and its bases as a list."""
    entries = dict.fromkeys(entry for description in described.values() for entry in description.labelled[part])
    return "\n".join("- " + entry.replace("\n", "\n  ") for entry in entries)


def _code(block: type[Block]) -> str:
    """Return the source of the block's file, folded."""
    file = inspect.getsourcefile(block)
    assert file is not None
    lines = ["```python", *Path(file).read_text(encoding="utf-8").splitlines(), "```"]
    folded = "\n".join(f"    {line}".rstrip() for line in lines)
    also = ", ".join(f"`{source_of(base)}`" for base in bases_of(block))
    shared = f"\n\nDerived from {also}." if also else ""
    return f'??? note "{source_of(block)}"\n\n{folded}{shared}'


def _place(block: type[Block]) -> str:
    own = slots_of(block)
    others = fitting(block)
    lines = []
    if own:
        siblings = [other.fmu_name for other in blocks_of_slot(own[-1]) if other is not block]
        others = [name for name in others if name not in siblings]
        slot = f"slot [{own[-1].fmu_name}](../slots.md#{own[-1].fmu_name})"
        lines.append(f"In the {slot}: {_linked(siblings)}." if siblings else f"It is the only block of the {slot}.")
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
        return "In no system by default; `--use SLOT=FMU` selects it."
    return table(["system", "component", "variant of the campaigns"], rows)


def _quoted(names: dict[str, list[str]], system: str) -> str:
    return ", ".join(f"`{name}`" for name in names.get(system, []))


def _section(title: str, content: str) -> str:
    return f"## {title}\n\n{content}" if content else ""
