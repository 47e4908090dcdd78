"""Block diagrams of the systems, for their pages on the site."""

from __future__ import annotations

from pathlib import Path

from perilune.analysis.documents.diagram.diagram import make_diagram
from perilune.analysis.runtime.ssp.archive import system_names
from perilune.analysis.runtime.system.prepared import prepare_system

IMAGES = "images/diagrams"
CAPTION = (
    "*Click to enlarge. Inputs are on the left of a block, outputs on the right; a vector is one line. Lines have the "
    "colour of the kind of block from which they come. `perilune describe {name} --report F.html` writes the diagram "
    "with tables of its connections.*"
)


def add_diagrams(docs: Path) -> None:
    """Insert each system's diagram, or the reason why there is none, before the first section of its page.

    ``docs`` is the folder of the site's Markdown. Raises InputError if an FMU is not built.
    """
    for name in system_names():
        page = docs / "systems" / f"{name}.md"
        if not page.is_file():
            continue
        diagram = make_diagram(prepare_system(name))
        section = diagram.missing
        if diagram.svg is not None:
            image = docs / IMAGES / f"{name}.svg"
            image.parent.mkdir(parents=True, exist_ok=True)
            image.write_text(str(diagram.svg), encoding="utf-8")
            link = f"../{IMAGES}/{name}.svg"
            section = f"[![Block diagram of {name}]({link})]({link})\n\n{CAPTION.format(name=name)}"
        text = page.read_text(encoding="utf-8")
        page.write_text(text.replace("\n## ", f"\n## Block diagram\n\n{section}\n\n## ", 1), encoding="utf-8")
