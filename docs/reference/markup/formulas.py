"""Conversion of a page's formulas, LaTeX between dollars, to MathML, which needs no script."""

from __future__ import annotations

import re

from latex2mathml.converter import convert

CODE = re.compile(r"(^```.*?^```$|`[^`\n]+`)", re.MULTILINE | re.DOTALL)
DISPLAYED = re.compile(r"^\$\$(.+?)\$\$$", re.MULTILINE | re.DOTALL)
INLINE = re.compile(r"(?<![\\$\w])\$([^\s$](?:[^$\n]*[^\s$])?)\$(?![\w$])")


def typeset(page: str) -> str:
    """Return a Markdown page with formulas as MathML: ``$$...$$`` on separate lines, ``$...$`` in the text.

    Formulas in the text are inside a span, since a line that begins with ``<math`` ends a Markdown paragraph.
    """
    parts = CODE.split(page)
    return "".join(part if index % 2 else _with_mathml(part) for index, part in enumerate(parts))


def _with_mathml(text: str) -> str:
    displayed = DISPLAYED.sub(
        lambda matches: f'<div class="formula">{convert(matches[1], display="block")}</div>', text
    )
    return INLINE.sub(lambda matches: f"<span>{convert(matches[1])}</span>", displayed)
