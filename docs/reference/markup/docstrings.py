"""Parser of the sections of a block's docstring: summary, model with equations, assumptions, frames, literature."""

from __future__ import annotations

import inspect
import re
from collections.abc import Set
from dataclasses import dataclass
from itertools import groupby

from ..markdown import CODE, escaped, linked
from .equations import CROSS, display, find_symbols, to_latex

INDENT = "    "
ASSUMPTIONS, FRAMES, SOURCES = "Assumptions", "Frames", "Sources"
LABELS = {
    "Assumes": ASSUMPTIONS,
    "Limits": ASSUMPTIONS,
    "Frame": FRAMES,
    "Frames": FRAMES,
    "Source": SOURCES,
    "Sources": SOURCES,
    "See": SOURCES,
    "Derivation": SOURCES,
}
LABELLED = re.compile(rf"({'|'.join(LABELS)})\b:? (.*)", re.DOTALL)
ARTICLES = {"a", "A"}  # symbols only where no noun follows
OPENING = ("See", "Derivation")  # labels that remain in the sentence


@dataclass(frozen=True)
class Description:
    """Docstring as Markdown: summary, paragraphs of the model, and paragraphs by label."""

    summary: str
    model: list[str]
    labelled: dict[str, list[str]]


def describe_class(described: type, root: str) -> Description:
    """Return the sections of a class's docstring; ``root`` is the relative path from the page to the site's root."""
    summary, *paragraphs = re.split(r"\n\s*\n", inspect.cleandoc(described.__doc__ or ""))
    description = Description(_prose(summary, root), [], {ASSUMPTIONS: [], FRAMES: [], SOURCES: []})
    equations = [line for paragraph in paragraphs for line in paragraph.splitlines() if line.startswith(INDENT)]
    symbols = find_symbols("\n".join(equations))
    for paragraph in paragraphs:
        matched = LABELLED.fullmatch(paragraph)
        if matched is None:
            description.model.append(_with_equations(paragraph, root, symbols))
            continue
        label, text = matched.groups()
        text = f"{label} {text}" if label in OPENING else text[:1].upper() + text[1:]
        description.labelled[LABELS[label]].append(_prose(text, root))
    return description


def _with_equations(paragraph: str, root: str, symbols: Set[str]) -> str:
    """Return a paragraph with indented lines typeset as equations, and their symbols typeset in the text."""
    sections: list[str] = []
    for are_equations, lines in groupby(paragraph.splitlines(), lambda line: line.startswith(INDENT)):
        text = "\n".join(lines)
        sections.extend(display(text) if are_equations else [_prose(text.replace("\n", " "), root, symbols)])
    return "\n\n".join(sections)


def _prose(text: str, root: str, symbols: Set[str] = frozenset()) -> str:
    texts = [
        section if index % 2 else _with_formulas(section, symbols) for index, section in enumerate(CODE.split(text))
    ]
    return linked("".join(texts), root)


def _with_formulas(text: str, symbols: Set[str]) -> str:
    """Return text with symbols, and expressions that contain them, as formulas."""
    if not symbols:
        return escaped(text)
    names = "|".join(sorted(map(re.escape, symbols - ARTICLES), key=len, reverse=True))
    articles = "".join(rf"|{name}(?! (?!and\b|of\b|in\b|is\b)[a-z]{{2,}})" for name in sorted(ARTICLES & symbols))
    symbol = rf"(?<![\w'])(?<!\w-)(?:{names}{articles})'*(?![\w'-])"
    operand = rf"(?:{symbol}|\d+(?:\.\d+)?(?!\w)|(?:sqrt|exp|min|max|sin|cos)(?=\())"
    run = re.compile(rf"((?:\d+ )?\|?{symbol}[|)]*(?:(?:\s*[=+/^·{CROSS}<>]=?\s*-?| - | ?[(|]|\s)*{operand}[|)]*)*)")
    texts = []
    for index, section in enumerate(run.split(text)):
        if index % 2 and _is_balanced(section):
            texts.append(f"${to_latex(section)}$")
        elif index % 2:
            sections = re.split(f"({symbol})", section)
            texts += [f"${to_latex(token)}$" if number % 2 else escaped(token) for number, token in enumerate(sections)]
        else:
            texts.append(escaped(section))
    return "".join(texts)


def _is_balanced(text: str) -> bool:
    """Return True if parentheses and bars of an expression are balanced."""
    return text.count("(") == text.count(")") and not text.count("|") % 2 and not text.startswith(")")
