"""All derived pages, by path on the site, and their position in the navigation."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from perilune.fmus_src.catalogue import KINDS, catalogue
from perilune.fmus_src.export.judge.subset_table import LANGUAGE_PAGE

from .blocks import block_page
from .formats.pages import format_navigation, format_pages
from .interface import interface_pages
from .kernel import kernel_page
from .lists import catalogue_page, kind_of, slots_page
from .verbs import verbs_page

TOP = Path(__file__).parents[2]  # of the sources; perilune may be imported from elsewhere
FRONT = {"README.md": "index.md", "CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changelog.md"}
LINK = re.compile(r"(\]\()([\w./-]+)((?:#[\w-]*)?\))")


def derived_pages() -> dict[str, str]:
    """Return the Markdown pages by path on the site: the repository's top-level pages, and the reference."""
    pages = {target: _front(TOP / source) for source, target in FRONT.items()}
    pages["reference/verbs.md"] = verbs_page()
    pages["reference/slots.md"] = slots_page()
    pages["reference/kernel.md"] = kernel_page()
    pages["reference/blocks/index.md"] = catalogue_page()
    pages |= {f"reference/blocks/{name}.md": block_page(block) for name, block in catalogue().items()}
    pages |= {f"reference/formats/{name}": text for name, text in format_pages().items()}
    pages |= {f"reference/python/{name}": text for name, text in interface_pages().items()}
    return pages


def reference_navigation() -> list[dict[str, Any]]:
    """Return the reference in the format of MkDocs' ``nav``."""
    blocks: list[Any] = ["reference/blocks/index.md"]
    for kind in KINDS:
        names = [name for name, block in catalogue().items() if kind_of(block) == kind]
        blocks.append({kind.capitalize(): [{name: f"reference/blocks/{name}.md"} for name in names]})
    return [
        {"Verbs": "reference/verbs.md"},
        {"Blocks": blocks},
        {"Slots": "reference/slots.md"},
        {LANGUAGE_PAGE: "reference/kernel.md"},
        {"Tables": format_navigation()},
        {
            "Python": [
                {"Flying and studying": "reference/python/flying.md"},
                {"Writing blocks": "reference/python/blocks.md"},
                {"perilune.modal": "reference/python/modal.md"},
            ]
        },
    ]


def _front(file: Path) -> str:
    """Return a top-level page of the repository with links adapted to the site, whose root is docs/."""
    return LINK.sub(lambda link: f"{link[1]}{_moved(link[2])}{link[3]}", file.read_text(encoding="utf-8"))


def _moved(target: str) -> str:
    return FRONT.get(target, target.removeprefix("docs/"))
