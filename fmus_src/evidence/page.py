"""Page of a block inside its FMU, documentation/index.html: HTML without scripts, generated from the declaration."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby

from lxml import etree, html
from lxml.html import builder

from ..block import Block
from ..variables import Input, Output, Parameter, Variable
from .manifest import FOLDER
from .variable_text import bounds_text, sized_name, start_text, unit_text

STYLE = """:root { color-scheme: light dark; }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 64rem; margin: 2rem auto; padding: 0 1rem; }
table { border-collapse: collapse; display: block; overflow-x: auto; }
th, td { text-align: left; vertical-align: top; padding: 0.2rem 1rem 0.2rem 0; border-bottom: 1px solid #8886; }
pre { margin-left: 2rem; overflow-x: auto; }
p { overflow-wrap: anywhere; }"""
VERIFY = "pip install perilune, then perilune verify FILE.fmu reproduces the trajectories of "
PARAGRAPH = re.compile(r"\n\s*\n|\n(?=Sources?\b|Frames?\b|Equations\b|Assumes\b)")
SECTIONS = (("Inputs", Input), ("Outputs", Output), ("Parameters", Parameter))


def block_page(block_class: type[Block]) -> bytes:
    """Return the page: purpose, equations and source from the docstring, tables of the variables."""
    body = [builder.H1(block_class.fmu_name), *_prose(block_class)]
    for base in block_class.__mro__[1:]:
        if issubclass(base, Block) and base is not Block:
            body += [builder.H2(base.fmu_name), *_prose(base)]
    for title, kind in SECTIONS:
        variables = [each for each in block_class.variables.values() if isinstance(each, kind)]
        if variables:
            body += [builder.H2(title), _table(variables)]
    body += [builder.H2("Verification"), builder.P(VERIFY, builder.CODE(FOLDER), ", where there are any.")]
    return page_of(block_class.fmu_name, body)


def page_of(title: str, body: Iterable[etree._Element]) -> bytes:
    """Return an FMU's page, which adapts to screen width and colour scheme."""
    screen = builder.META(name="viewport", content="width=device-width, initial-scale=1")
    head = builder.HEAD(builder.META(charset="utf-8"), screen, builder.TITLE(title), builder.STYLE(STYLE))
    page = builder.HTML(head, builder.BODY(*body), lang="en")
    return html.tostring(page, doctype="<!DOCTYPE html>", encoding="utf-8", pretty_print=True)


def _prose(block_class: type[Block]) -> list[etree._Element]:
    """Return a docstring as HTML paragraphs, with indented equations preformatted."""
    paragraphs: list[etree._Element] = []
    for is_equation, lines in groupby(inspect.cleandoc(block_class.__doc__ or "").splitlines(), _is_equation):
        if is_equation:
            paragraphs.append(builder.PRE(inspect.cleandoc("\n".join(lines))))
        else:
            paragraphs += [builder.P(*_with_code(text)) for text in PARAGRAPH.split("\n".join(lines)) if text.strip()]
    return paragraphs


def _with_code(text: str) -> Iterator[str | etree._Element]:
    """Yield the HTML of a text, with passages between backticks as code."""
    for index, words in enumerate(text.split("`")):
        yield builder.CODE(words) if index % 2 else words


def _is_equation(line: str) -> bool:
    return line.startswith("    ")


def _table(variables: Sequence[Variable]) -> etree._Element:
    rows = [["name", "type", "start", "unit", "bounds", "frame", "description"]]
    for each in variables:
        start = "" if isinstance(each, Output) else start_text(each)
        limits = [unit_text(each), bounds_text(each), each.frame or ""]
        rows.append([sized_name(each), each.fmi_type, start, *limits, each.description])
    filled = [index for index in range(len(rows[0])) if any(row[index] for row in rows[1:])]
    header, *others = [[row[index] for index in filled] for row in rows]
    lines = [builder.TR(*map(builder.TH, header)), *(builder.TR(*map(builder.TD, row)) for row in others)]
    return builder.TABLE(*lines)
