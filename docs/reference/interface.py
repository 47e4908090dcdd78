"""Pages of the Python interface: every public name; mkdocstrings reads signatures and docstrings."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from importlib import import_module

from perilune.analysis.options.declaration import Verb
from perilune.analysis.options.docstring import call_of, find_example, option_text, type_text
from perilune.analysis.options.option import options_of
from perilune.analysis.verbs.options.verbs import VERBS
from perilune.fmus_src.face import HOMES

from .markdown import escaped, prose, table

CALLED = {verb.home[1]: verb for verb in VERBS.values() if not verb.is_command_alone}  # by name of the verb's function
WRITING = [name for names in HOMES.values() for name in names]  # names for writing blocks


def interface_pages() -> dict[str, str]:
    """Return the Markdown pages by file name, for reference/python: running, writing blocks, modal synthesis."""
    public = _names_of("perilune")
    flying = [name for name in public if name not in WRITING and name != "modal"]
    modal = import_module("perilune.modal")
    return {
        "flying.md": _page(
            "Simulations and studies",
            "`import perilune` provides simulations, campaigns and studies, and the types of their results.",
            "perilune",
            sorted(flying, key=lambda name: (name[0].isupper(), name)),
        ),
        "blocks.md": _page(
            "Writing blocks",
            "`from perilune import ...` provides the names that a user's block needs: see "
            "[write your own guidance](../../write_your_own.md). [Slots](../slots.md) lists the connectors of each "
            "interface.",
            "perilune",
            [name for name in WRITING if name in public],
        ),
        "modal.md": _page(
            "perilune.modal",
            f"{prose(modal.__doc__, '../../')}\n\n[Modal synthesis](../../modal_synthesis.md) helps to choose.",
            "perilune.modal",
            sorted(_names_of("perilune.modal"), key=lambda name: (name[0].isupper(), name)),
        ),
    }


def _names_of(module: str) -> list[str]:
    return list(import_module(module).__all__)


def _page(title: str, words: str, module: str, names: Iterable[str]) -> str:
    entries = [part for name in names for part in (f"::: {module}.{name}", *_keywords(CALLED.get(name)))]
    return "\n\n".join([f"# {title}", words, *entries]) + "\n"


def _keywords(verb: Verb | None) -> Iterator[str]:
    """Yield the keywords of a verb's function and its example, from the declaration that `help()` uses as well."""
    if verb is None:
        return
    rows = [
        [f"`{declared.name}`", escaped(type_text(declared)), escaped(option_text(verb, declared))]
        for declared in options_of(verb.options).values()
    ]
    if rows:
        yield table(["keyword", "type and default", "meaning"], rows)
    if example := find_example(verb):
        yield f"```python\n{call_of(verb, example)}\n```"
