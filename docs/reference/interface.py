"""The pages of the Python interface: every public name, whose signature and docstring mkdocstrings reads."""

from __future__ import annotations

from collections.abc import Iterable
from importlib import import_module

from perilune.fmus_src.face import HOMES

from .markdown import prose

WRITING = [name for names in HOMES.values() for name in names]  # what one writes a block with


def interface_pages() -> dict[str, str]:
    """Markdown by file name, to lie in reference/python: flying, writing blocks, modal synthesis."""
    public = _names_of("perilune")
    flying = [name for name in public if name not in WRITING and name != "modal"]
    modal = import_module("perilune.modal")
    return {
        "flying.md": _page(
            "Flying and studying",
            "`import perilune` gives what flies systems, campaigns and studies, and what they return.",
            "perilune",
            sorted(flying, key=lambda name: (name[0].isupper(), name)),
        ),
        "blocks.md": _page(
            "Writing blocks",
            "`from perilune import ...` gives what a block of your own takes: see "
            "[write your own guidance](../../write_your_own.md). [Slots](../slots.md) has the connectors of each "
            "interface.",
            "perilune",
            [name for name in WRITING if name in public],
        ),
        "modal.md": _page(
            "perilune.modal",
            f"{prose(modal.__doc__, '../../')}\n\n[Modal synthesis](../../modal_synthesis.md) says which to take.",
            "perilune.modal",
            sorted(_names_of("perilune.modal"), key=lambda name: (name[0].isupper(), name)),
        ),
    }


def _names_of(module: str) -> list[str]:
    return list(import_module(module).__all__)


def _page(title: str, words: str, module: str, names: Iterable[str]) -> str:
    return "\n\n".join([f"# {title}", words, *(f"::: {module}.{name}" for name in names)]) + "\n"
