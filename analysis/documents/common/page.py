"""Pages from jinja2 templates: one style sheet, no external resources."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

from markupsafe import Markup

from ....common.atomic import write_atomically
from ....common.percent import percent
from ..interactive.charts import Drawing
from ..interactive.embedded import Embedded
from .colours import colour_properties
from .contents import Contents
from .quantities import display_unit, in_display_unit, number

FOLDER = Path(__file__).parent


def exact(value: Any, unit: str | None = None, digits: int = 4, decimals: int | None = None) -> Markup:
    """Return a number in its displayed unit, with the exact SI value in the markup for programs.

    It has ``digits`` significant digits, or ``decimals`` decimals.
    """
    displayed = number(in_display_unit(value, unit), digits, decimals)
    if value is None or isinstance(value, str):
        return Markup("<span>{}</span>").format(displayed)
    return with_exact(str(value).lower() if isinstance(value, bool) else repr(value), displayed)


def with_exact(exact_value: str, displayed: str) -> Markup:
    """Return a text with the exact SI value in the markup for programs."""
    return Markup('<data value="{}">{}</data>').format(exact_value, displayed)


def breakable(name: str) -> Markup:
    """Return a variant's name with permitted line breaks before each of its FMUs."""
    return Markup("__<wbr>").join(name.split("__"))


def render_page(template: Path, **content: Any) -> str:
    """Render a page from a template, which may include templates of this folder and of the template's folder.

    A name that the template needs but does not receive is an error.
    """
    from jinja2 import Environment, FileSystemLoader, StrictUndefined  # not needed for the numbers of a terminal

    environment = Environment(
        loader=FileSystemLoader([template.parent, FOLDER]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        extensions=["jinja2.ext.do"],
    )
    embedded = Embedded()
    environment.globals["contents"] = Contents()
    environment.filters |= {
        "answering": partial(make_interactive, embedded=embedded),
        "exact": exact,
        "unit": display_unit,
        "number": number,
        "breakable": breakable,
        "percent": percent,
    }
    styles = (FOLDER / "page.css", FOLDER.parent / "interactive" / "interactive.css")
    style = Markup(colour_properties() + "".join(path.read_text(encoding="utf-8") for path in styles))
    return environment.get_template(template.name).render(style=style, embedded=embedded, **content)


def make_interactive(figure: Drawing, embedded: Embedded) -> Markup:
    """Return a figure whose values the page's script shows at the cursor."""
    svg = figure.svg
    number = embedded.add_figure(figure.charts)
    return svg if number is None else Markup('<svg data-figure="{}" {}').format(number, svg.removeprefix("<svg "))


def write_page(path: Path, template: Path, **content: Any) -> None:
    """Write a page and, if necessary, its folder."""
    write_atomically(path, render_page(template, **content).encode())
