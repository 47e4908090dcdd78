"""Pages that list blocks: all blocks by kind, and the slots with their interchangeable blocks."""

from __future__ import annotations

from perilune.analysis.authoring.fits import blocks_of_slot, slots
from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import KINDS, catalogue

from .blocks import slots_of
from .markdown import escaped, table
from .markup.docstrings import describe_class
from .variables import inputs, outputs, parameters


def kind_of(block: type[Block]) -> str:
    """Return the kind of a block by its folder: plants, sensors, ..."""
    return block.__module__.split(".")[-2]


def catalogue_page() -> str:
    """Return the Markdown list of all blocks by kind, for reference/blocks."""
    sections = [
        "# Blocks",
        f"All {len(catalogue())} blocks of the repository; each is an FMU of the same name. `perilune describe NAME` "
        "prints variables of an FMU, of a slot or of a system.",
    ]
    for kind in KINDS:
        rows = [
            [f"[{name}]({name}.md)", _slot(block, "../"), escaped(block.summary())]
            for name, block in catalogue().items()
            if kind_of(block) == kind
        ]
        sections += [f"## {kind.capitalize()}", table(["block", "slot", "description"], rows)]
    return "\n\n".join(sections) + "\n"


def slots_page() -> str:
    """Return the Markdown list of all interfaces, for reference."""
    sections = [
        "# Slots",
        "A slot is an interface, the common variables of its blocks, which `--use SLOT=FMU` exchanges. Some entries "
        "are bases between a slot and a few of its blocks.",
    ]
    for name, slot in slots().items():
        members = blocks_of_slot(slot)
        rows = [[f"[{block.fmu_name}](blocks/{block.fmu_name}.md)", escaped(block.summary())] for block in members]
        sections += [f"## {name}", *describe_slot(slot), table(["block", "description"], rows)]
        for title, content in (("Inputs", inputs(slot)), ("Outputs", outputs(slot)), ("Parameters", parameters(slot))):
            if content:
                sections.append(
                    f'??? note "{title} of {name}"\n\n' + "\n".join(f"    {row}" for row in content.splitlines())
                )
    return "\n\n".join(sections) + "\n"


def describe_slot(slot: type[Block]) -> list[str]:
    """Return the paragraphs of a slot's docstring."""
    described = describe_class(slot, "../")
    labelled = [f"{title}: {text}" for title, texts in described.labelled.items() for text in texts]
    return [described.summary, *described.model, *labelled]


def _slot(block: type[Block], root: str) -> str:
    own = slots_of(block)
    return f"[{own[-1].fmu_name}]({root}slots.md#{own[-1].fmu_name})" if own else ""
