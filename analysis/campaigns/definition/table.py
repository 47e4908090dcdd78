"""Checked reading of a TOML file: InputError names any unknown key and any value of a wrong type."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, TypeVar

from ....common.errors import InputError
from .expressions import Expression

T = TypeVar("T")
REQUIRED: Any = object()


class TomlTable:
    """Table of a TOML file; ``element`` is the table's path in the file, such as ``metric.position_error``.

    ``origins`` maps paths of values to file and line, if the values are from several files. ``attached`` maps a file
    and a reference in it to the label and the content of the referenced file; the content is None if that file is
    missing.
    """

    def __init__(
        self,
        content: Mapping[str, object],
        file: str,
        element: str = "",
        origins: Mapping[str, tuple[str, int]] | None = None,
        attached: Mapping[tuple[str, str], tuple[str, bytes | None]] | None = None,
    ) -> None:
        self.content = content
        self.file = file
        self.element = element
        self.origins = origins or {}
        self.attached = attached or {}

    def place(self, key: str) -> str:
        return f"{self.element}.{key}" if self.element else key

    def where(self, key: str) -> tuple[str, str]:
        """Return file and position of a key for error messages."""
        place = self.place(key) if key else self.element
        return self.origin(place)[0], place

    def origin(self, name: str) -> tuple[str, int]:
        """Return file and line of a key, or of the innermost table that contains it; line 0 if unknown."""
        parts = re.split(r"(?=[.\[])", name)
        nearest = ("".join(parts[:count]) for count in range(len(parts), 0, -1))
        return next((self.origins[part] for part in nearest if part in self.origins), (self.file, 0))

    def error(self, key: str, problem: str, remedy: str) -> InputError:
        return InputError(*self.where(key), problem, remedy)

    def only(self, allowed: Iterable[str]) -> None:
        names = list(allowed)
        for key in self.content:
            if key not in names:
                raise self.error(key, "unknown key", f"allowed here: {', '.join(names)}")

    def get(self, key: str, kind: Callable[[TomlTable, str, object], T], default: T = REQUIRED) -> T:
        """Return the value of ``key``, read by ``kind`` (`text`, `number`, ...), or ``default`` without such a key."""
        if key in self.content:
            return kind(self, key, self.content[key])
        if default is REQUIRED:
            raise self.error(key, "missing", f"add {key} = ... to the {self.element or 'top of the file'}")
        return default

    def table(self, key: str) -> TomlTable:
        """Return the subtable ``key``; an empty table if the key is missing."""
        value = self.content.get(key, {})
        if not isinstance(value, dict):
            raise self.error(key, "not a table", f"write [{self.place(key)}] and its keys below it")
        return TomlTable(value, self.file, self.place(key), self.origins, self.attached)

    def subtables(self) -> list[tuple[str, TomlTable]]:
        """Return name and table of every entry; names are identifiers."""
        for name in self.content:
            if not name.isidentifier():
                raise self.error(name, f"{name!r} is not a plain name", "use letters, digits and _")
        return [(name, self.table(name)) for name in self.content]

    def flat(self, of_tables: bool = False) -> Iterator[tuple[str, object]]:
        """Yield name and value of the entries; names in nested tables become dotted: a.b = 1 is the same as "a.b" = 1.

        With ``of_tables`` the entries are tables themselves, and only tables of tables are flattened.
        """

        def walk(prefix: str, content: Mapping[str, object]) -> Iterator[tuple[str, object]]:
            for key, value in content.items():
                inner = value if isinstance(value, dict) else {}
                if inner and (not of_tables or all(isinstance(entry, dict) for entry in inner.values())):
                    yield from walk(f"{prefix}{key}.", inner)
                else:
                    yield prefix + key, value

        known: set[str] = set()
        for name, value in walk("", self.content):
            if name in known:
                raise self.error(name, "occurs twice, with and without quotes", "keep one of the two")
            known.add(name)
            yield name, value


def text(table: TomlTable, key: str, value: object) -> str:
    """Return a string that is not empty."""
    if not isinstance(value, str) or not value.strip():
        raise table.error(key, f"{value!r} is not a text", 'write it in quotes: "..."')
    return value.strip()


def integer(table: TomlTable, key: str, value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise table.error(key, f"{value!r} is not a whole number", "write an integer")
    return value


def bound(table: TomlTable, key: str, value: object) -> float:
    """Return a number, possibly infinite, also from a constant expression such as "-pi/4"."""
    if isinstance(value, str):
        formula = Expression(value, table.where(key))
        if formula.names:
            raise table.error(key, f"{value!r} is not constant", "use numbers, pi and e only, or [derive]")
        value = formula.evaluate({})
    if isinstance(value, bool) or not isinstance(value, int | float) or math.isnan(value):
        raise table.error(key, f"{value!r} is not a number", 'write a number, or a constant expression such as "pi/4"')
    return float(value)


def number(table: TomlTable, key: str, value: object) -> float:
    """Return a finite number, also from a constant expression."""
    read = bound(table, key, value)
    if not math.isfinite(read):
        raise table.error(key, f"{value!r} is not finite", "write a finite number")
    return read


def sequence(kind: Callable[[TomlTable, str, object], T]) -> Callable[[TomlTable, str, object], tuple[T, ...]]:
    """Return a reader of arrays with at least one value, all read by ``kind``."""

    def read(table: TomlTable, key: str, value: object) -> tuple[T, ...]:
        if not isinstance(value, list) or not value:
            raise table.error(key, f"{value!r} is not a list of values", "write [a, b, ...] with one or more values")
        return tuple(kind(table, f"{key}[{index + 1}]", entry) for index, entry in enumerate(value))

    return read


def numbers(table: TomlTable, key: str, value: object) -> tuple[float, ...]:
    """Return an array of at least one finite number."""
    return sequence(number)(table, key, value)


def names(table: TomlTable, key: str, value: object) -> tuple[str, ...]:
    """Return an array of at least one text, without repetitions."""
    listed = sequence(text)(table, key, value)
    for name in listed:
        if listed.count(name) > 1:
            raise table.error(key, f"{name!r} occurs twice", "name it once")
    return listed


def expression(table: TomlTable, key: str, value: object) -> Expression:
    """Return the expression in a text; see `Expression`."""
    return Expression(text(table, key, value), table.where(key))


def choice_of(*allowed: str) -> Callable[[TomlTable, str, object], str]:

    def read(table: TomlTable, key: str, value: object) -> str:
        if value not in allowed:
            raise table.error(key, f"{value!r} is not known", f"use one of {', '.join(allowed)}")
        return value

    return read
