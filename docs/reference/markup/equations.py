"""Conversion of equations in docstrings, plain text on indented lines, to LaTeX.

In equations such as ``J ω' = (J ω) × ω + u`` a prime denotes a time derivative and a space a product; ``_`` begins an
index, ``^T`` is a transpose, and ``/`` divides its two neighbours. A name of several letters is a function or a
variable of the block; three spaces separate equations on a line.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

TOKEN = re.compile(r"(\s*)(<=|>=|atan2|\d+(?:\.\d+)?(?:e-?\d+)?|[^\W\d_]+(?:_[^\W_]+)*|'+|\S)")
SEVERAL = re.compile(r" {3,}")
CONDITION = re.compile(r"(if) (.*)")
FUNCTIONS = {"asin", "atan", "atan2", "clip", "cos", "diag", "exp", "lim", "max", "min", "sgn", "sin", "tan"}
CROSS = "\N{MULTIPLICATION SIGN}"
NAMED = {
    "<=": r"\le",
    ">=": r"\ge",
    CROSS: r"\times",
    "·": r"\cdot",
    "Σ": r"\sum",
    "∫": r"\int",
    "∇": r"\nabla",
    "±": r"\pm",
    "#": r"\#",
}
CLOSING = {"(": ")", "[": "]"}
SPACE = r"\,"
TRANSPOSE = r"\top"
RELATIONS = {"=", "<", ">", "<=", ">=", "+", "-", CROSS, "·", "±", ",", ";", ":"}
TIGHT = {NAMED.get(token, token) for token in RELATIONS | NAMED.keys()}  # without a space after them


def display(text: str) -> Iterator[str]:
    """Yield each line of equations as a displayed formula."""
    for line in filter(None, map(str.strip, text.splitlines())):
        yield f"$${to_latex(line)}$$"


def to_latex(line: str) -> str:
    """Return a line of equations as LaTeX, separated by quads."""
    formulas: list[str] = []
    for text in SEVERAL.split(line.strip()):
        condition = CONDITION.fullmatch(text)
        formulas.append(rf"\text{{if }}{_Reader(condition[2]).read()}" if condition else _Reader(text).read())
    return r"\qquad ".join(formulas)


def find_symbols(text: str) -> set[str]:
    """Return the one-letter names, with their indices, in equations."""
    tokens = {token for _, token in TOKEN.findall(text)}
    return {token for token in tokens if token.partition("_")[0].isalpha() and len(token.partition("_")[0]) == 1}


class _Reader:
    """Parser of one equation: its tokens, read from left to right."""

    def __init__(self, text: str) -> None:
        self.tokens = TOKEN.findall(text)
        self.position = 0

    def read(self) -> str:
        """Return the LaTeX of all tokens."""
        return " ".join(self._factors(None))

    def _next(self) -> str:
        """Return the next token without consuming it; empty at the end."""
        token: str = self.tokens[self.position][1] if self.position < len(self.tokens) else ""
        return token

    def _take(self) -> str:
        token = self._next()
        self.position += 1
        return token

    def _is_applied(self) -> bool:
        """Return True if a parenthesis follows without a space, which begins the arguments of a function."""
        return self._next() == "(" and not self.tokens[self.position][0]

    def _factors(self, end: str | None) -> list[str]:
        """Return the LaTeX before the token ``end``, and consume that token."""
        factors: list[str] = []
        while token := self._next():
            if token == end:
                self._take()
                break
            if token in RELATIONS:
                factors.append(NAMED.get(self._take(), token))
                continue
            if token == "/":
                self._take()
                numerator = _take_product(factors)
                factors.append(rf"\frac{{{_bare(numerator)}}}{{{_bare(self._factor())}}}")
                continue
            if factors and factors[-1] not in TIGHT:
                factors.append(SPACE)
            factors.append(self._factor())
        return factors

    def _factor(self) -> str:
        """Return an operand with its arguments, primes and exponent."""
        base = self._operand()
        if (primes := self._next()).startswith("'"):
            self._take()
            base = _derived(base, len(primes))
        if self._is_applied():
            base += self._operand()
        if self._next() == "^":
            self._take()
            exponent = _bare(self._factor())
            base = f"{{{base}}}^{{{TRANSPOSE if exponent == 'T' else exponent}}}"
        return base

    def _operand(self) -> str:
        token = self._take()
        if token in CLOSING:
            factors = self._factors(CLOSING[token])
            if len(factors) == 1 and factors[0].startswith(r"\frac") and self._next() != "^":
                return factors[0]
            return rf"\left{token}{' '.join(factors)}\right{CLOSING[token]}"
        if token == "|":
            return rf"\left|{' '.join(self._factors('|'))}\right|"
        if token == "sqrt":
            self._take()
            return rf"\sqrt{{{' '.join(self._factors(')'))}}}"
        if token == "-":
            return "-" + self._factor()
        if token in FUNCTIONS:
            name = rf"\operatorname{{{token}}}"
            return name + (self._operand() if self._is_applied() else rf"\,{self._factor()}")
        return _name(token)


def _take_product(factors: list[str]) -> str:
    """Remove and return the trailing factors, back to the last sign or fraction."""
    start = len(factors)
    while start and factors[start - 1] not in TIGHT and not factors[start - 1].startswith(r"\frac"):
        start -= 1
    start += start < len(factors) and factors[start] == SPACE
    product = " ".join(factors[start:])
    del factors[start:]
    return product


def _derived(base: str, times: int) -> str:
    """Return a time derivative, with the dot above the letter but not above its index."""
    letter, separator, index = base.partition("_{")
    dot = r"\dot" if times == 1 else r"\ddot"
    return f"{dot}{{{letter}}}{separator}{index}"


def _name(token: str) -> str:
    head, _, index = token.partition("_")
    if len(head) > 1 and head[0] in "δΔ":
        return f"{head[0]} {_name(token[1:])}"
    if len(head) > 1 and head.isalpha():
        escaped = token.replace("_", r"\_")
        return rf"\mathrm{{{escaped}}}"
    symbol = NAMED.get(head, head)
    if not index:
        return symbol
    return f"{symbol}_{{{index}}}" if len(index) == 1 else rf"{symbol}_{{\mathrm{{{index}}}}}"


def _bare(operand: str) -> str:
    """Return an operand without enclosing parentheses."""
    inner = operand.removeprefix(r"\left(").removesuffix(r"\right)")
    return inner if len(operand) - len(inner) == len(r"\left(\right)") and _is_balanced(inner) else operand


def _is_balanced(text: str) -> bool:
    """Return True if every parenthesis of a text is closed within it."""
    depth = 0
    for match in re.finditer(r"\\(left|right)\b", text):
        depth += 1 if match[1] == "left" else -1
        if depth < 0:
            return False
    return True
