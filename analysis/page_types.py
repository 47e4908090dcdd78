"""Writer of web/generated/*.ts: TypeScript types of page documents and of the queries and answers of `perilune show`.

The types are declared as dataclasses, TypedDicts and Structs next to the code that fills or reads them. The classes in
`ROOTS` and all classes of their members are written, one file per module. Arrays become columns, whose type is a number
inside a page and the decoded array in a script.
"""

from __future__ import annotations

import inspect
import json
import types
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import is_dataclass
from pathlib import Path
from typing import Any, Literal, NamedTuple, NotRequired, Union, get_args, get_origin, get_type_hints, is_typeddict

import msgspec
import numpy as np

from ..common.paths import ROOT
from .documents.common import colours
from .documents.common.colours import FAINT, GRID, INK, SHADES, SHIP
from .documents.interactive.charts import Chart
from .documents.interactive.columns import Coarse, Packed
from .documents.interactive.embedded import is_optional, page_fields
from .documents.of.batch.embedded_flights import RecordedDocument
from .documents.of.batch.embedded_trials import TrialsDocument
from .documents.scene.view import SceneView
from .show.documents import Counts, ShowDocument, TrialEntry
from .show.query import Query

GENERATED = ROOT / "web" / "generated"
PLAIN = {str: "string", int: "number", float: "number", bool: "boolean", type(None): "null"}
COLUMNS = (np.ndarray, Coarse)


class PageDocument(Packed):
    """The document inside a page: its columns, its figures, and data that the scripts of some pages read."""

    figures: list[list[Chart]]
    trials: NotRequired[TrialsDocument]
    recorded: NotRequired[RecordedDocument]
    scene: NotRequired[SceneView]
    show: NotRequired[ShowDocument]


ROOTS = (PageDocument, Query, Counts, TrialEntry)


class UntranslatableError(TypeError):
    """Error for a member whose type has no counterpart in TypeScript."""


class InterfaceMember(NamedTuple):
    """A member of an interface with its Python type."""

    name: str
    type: Any
    optional: bool


def write_types(folder: Path = GENERATED) -> None:
    """Write the generated files that changed, and remove obsolete ones."""
    texts = generate()
    folder.mkdir(exist_ok=True)
    for path in folder.glob("*.ts"):
        if path.name not in texts:
            path.unlink()
    for name, text in texts.items():
        path = folder / name
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def generate() -> dict[str, str]:
    """Return the text of each file by name: the interfaces of `ROOTS` and the colours."""
    constants: dict[str, Mapping[str, object]] = {
        "SHADES": SHADES,
        "SHIP": SHIP,
        "FIGURE": {"ink": INK, "faint": FAINT, "grid": GRID},
    }
    tables = []
    for name, table in constants.items():
        entries = "".join(f"  {key}: {json.dumps(colour)},\n" for key, colour in table.items())
        tables.append(f"export const {name} = {{\n{entries}}} as const;\n")
    return translate(ROOTS) | {"colours.ts": "\n".join([_head(colours.__name__), *tables])}


def translate(roots: Sequence[type]) -> dict[str, str]:
    """Return the text of each file by name: the interfaces of these classes and of all classes of their members."""
    modules: dict[str, list[type]] = {}
    for declared in _collect(roots):
        modules.setdefault(declared.__module__, []).append(declared)
    return {f"{_file_of(module)}.ts": _write_file(module, classes) for module, classes in sorted(modules.items())}


def _collect(roots: Sequence[type]) -> list[type]:
    """Return the declared classes reachable from ``roots``, ordered by module and line."""
    collected: set[type] = set()
    pending = list(roots)
    while pending:
        declared = pending.pop()
        if declared not in collected:
            collected.add(declared)
            pending.extend(each for member in _members(declared) for each in _iterate_declared(member.type))
    return sorted(collected, key=lambda each: (each.__module__, inspect.getsourcelines(each)[1]))


def _members(declared: type) -> Iterator[InterfaceMember]:
    hints = get_type_hints(declared)
    if is_dataclass(declared):
        for each in page_fields(declared):
            optional = is_optional(each)
            yield InterfaceMember(
                each.name, _without_none(hints[each.name]) if optional else hints[each.name], optional
            )
    elif issubclass(declared, msgspec.Struct):
        yield from (
            InterfaceMember(each.name, hints[each.name], not each.required) for each in msgspec.structs.fields(declared)
        )
    else:
        stated = get_type_hints(declared, include_extras=True)
        for name, hint in hints.items():
            # With annotations as text __optional_keys__ reflects only the class's totality.
            optional = name in getattr(declared, "__optional_keys__", ()) or get_origin(stated[name]) is NotRequired
            yield InterfaceMember(name, hint, optional)


def _iterate_declared(hint: Any) -> Iterator[type]:
    """Yield the declared classes that a type mentions."""
    if _is_declared(hint):
        yield hint
    for each in get_args(hint):
        yield from _iterate_declared(each)


def _is_declared(hint: Any) -> bool:
    return is_dataclass(hint) or is_typeddict(hint) or (isinstance(hint, type) and issubclass(hint, msgspec.Struct))


def _without_none(hint: Any) -> Any:
    if get_origin(hint) not in (Union, types.UnionType):
        return hint
    return Union[tuple(each for each in get_args(hint) if each is not type(None))]  # noqa: UP007


def _write_file(module: str, classes: Sequence[type]) -> str:
    imported: dict[str, set[str]] = {}
    for declared in classes:
        for each in (each for member in _members(declared) for each in _iterate_declared(member.type)):
            if each.__module__ != module:
                imported.setdefault(_file_of(each.__module__), set()).add(each.__name__)
    lines = [_head(module).rstrip()] + [""] * bool(imported)
    lines += [
        f'import type {{ {", ".join(sorted(names))} }} from "./{file}";' for file, names in sorted(imported.items())
    ]
    return "\n".join([*lines, "", *map(_write_interface, classes)])


def _write_interface(declared: type) -> str:
    comment = "".join(f"// {line}".rstrip() + "\n" for line in inspect.cleandoc(declared.__doc__ or "").splitlines())
    parameter = "<Column = number>" if _has_columns(declared) else ""
    members = "".join(
        f"  {each.name}{'?' * each.optional}: {_translate_type(each.type, f'{declared.__name__}.{each.name}')};\n"
        for each in _members(declared)
    )
    return f"{comment}export interface {declared.__name__}{parameter} {{\n{members}}}\n"


def _has_columns(hint: Any) -> bool:
    if _is_declared(hint):
        return any(_has_columns(each.type) for each in _members(hint))
    return hint in COLUMNS or any(map(_has_columns, get_args(hint)))


def _translate_type(hint: Any, member: str) -> str:
    """Return a Python type as TypeScript. Raises UntranslatableError, which names ``member``."""
    if hint in PLAIN:
        return PLAIN[hint]
    if hint in COLUMNS:
        return "Column"
    if _is_declared(hint):
        return f"{hint.__name__}{'<Column>' if _has_columns(hint) else ''}"
    origin, arguments = get_origin(hint), get_args(hint)
    if origin is Literal:
        return " | ".join(map(json.dumps, arguments))
    translated = [_translate_type(each, member) for each in arguments if each is not ...]
    if origin in (Union, types.UnionType):
        return " | ".join(dict.fromkeys(translated))
    if origin is tuple and ... not in arguments:
        return f"[{', '.join(translated)}]"
    if origin in (list, tuple, Sequence):
        return f"({translated[0]})[]" if "|" in translated[0] else f"{translated[0]}[]"
    if origin is dict:
        return f"Record<{', '.join(translated)}>"
    raise UntranslatableError(f"{member}: {hint} has no counterpart in TypeScript; declare str, float, a list, ...")


def _head(module: str) -> str:
    path = module.removeprefix("perilune.").replace(".", "/")
    return f"// Written by build_web.py from {path}.py.\n"


def _file_of(module: str) -> str:
    return module.rpartition(".")[2]
