"""Declaration of an option: a key of a TypedDict, ``name: Annotated[type, Option(text, default, ...)]``.

Groups of options may inherit from one another. `options_of` reads the declarations. The parser of the command line, the
signature of the Python function, printed commands, records in manifests and JSON, and the tables of the documentation
derive from them.
"""

from __future__ import annotations

import os
import types
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import cache
from typing import Annotated, Literal, Protocol, Union, get_args, get_origin, get_type_hints

EMPTY: Mapping[str, object] = types.MappingProxyType({})  # empty default of an option with pairs
FilePath = str | os.PathLike[str]
ParameterValue = float | int | bool | str
SetValue = ParameterValue | Sequence[ParameterValue]  # value of a variable, or of all elements of a vector


class StructuredArray(Protocol):
    """A NumPy array with named columns."""

    @property
    def dtype(self) -> object: ...


@dataclass(frozen=True)
class Option:
    """Declaration of an option; its name is the annotated key.

    ``default`` is the value of an omitted option; the default of a mutable type is an empty constant. ``flag`` is the
    name on the command line if different: the singular for an option that may be repeated. ``above``, ``minimum`` and
    ``maximum`` bound a number. ``completer`` names a function of `verbs/options/completers`. ``comma`` allows several
    values in one text, separated by commas. ``needs`` names the file option without which the option has no effect on
    the command line. For a file, ``suffixes`` are the permitted suffixes of its name, ``is_folder`` marks a folder, and
    ``writer`` is the method of the result that writes it.
    """

    text: str
    default: object = None
    unit: str = ""
    metavar: str | None = None
    flag: str = ""
    above: float | None = None
    minimum: float | None = None
    maximum: float | None = None
    completer: str = ""
    comma: bool = False
    needs: str = ""
    suffixes: tuple[str, ...] = ()
    writer: str = ""
    is_folder: bool = False
    form: str = field(default="NAME=VALUE")  # form of a pair in help texts


class Kind(Enum):
    """Kind of an option's text on the command line."""

    FLAG = "flag"
    NUMBER = "number"
    INTEGER = "integer"
    TEXT = "text"
    PATH = "path"
    LIST = "list"  # list of texts or numbers
    PAIRS = "pairs"  # NAME=VALUE


@dataclass(frozen=True)
class Declared:
    """An option with its name and properties of its type: kind, kind of its elements, choices."""

    name: str
    option: Option
    annotation: object
    kind: Kind
    element: Kind
    choices: tuple[str, ...]

    @property
    def takes_paths(self) -> bool:
        """True if the option consists of pairs whose values are names or paths."""
        mappings = members_of(self.annotation)
        return self.kind is Kind.PAIRS and any(os.PathLike in _origins(mapping) for mapping in mappings)

    @property
    def flag(self) -> str:
        """The name on the command line, without dashes."""
        return (self.option.flag or self.name).replace("_", "-")


@cache
def options_of(group: type) -> Mapping[str, Declared]:
    """Return the options of a group by name, inherited ones first."""
    declared = {}
    for name, hint in get_type_hints(group, include_extras=True).items():
        if get_origin(hint) is not Annotated:
            raise TypeError(f"{group.__name__}.{name} has no Option")
        annotation, option = get_args(hint)
        kind, element = _kinds(annotation)
        declared[name] = Declared(name, option, annotation, kind, element, _choices(annotation))
    return types.MappingProxyType(declared)


def defaults_of(group: type) -> dict[str, object]:
    """Return the defaults of a group's options by name."""
    return {name: each.option.default for name, each in options_of(group).items()}


def members_of(annotation: object) -> tuple[object, ...]:
    """Return the alternatives of a type, except None."""
    if get_origin(annotation) in (Union, types.UnionType):
        return tuple(inner for member in get_args(annotation) for inner in members_of(member))
    return () if annotation is type(None) else (annotation,)


def _choices(annotation: object) -> tuple[str, ...]:
    members = members_of(annotation)
    choices = [text for member in members if get_origin(member) is Literal for text in get_args(member)]
    if not choices and len(members) == 1 and get_origin(members[0]) is not None:  # the choices of a list's elements
        inner = get_args(members[0])
        choices = list(_choices(inner[0])) if inner and get_origin(members[0]) is Sequence_ else []
    return tuple(choices)


def _origins(mapping: object) -> set[object]:
    """Return the types of a mapping's values, without their parameters."""
    return {get_origin(each) or each for value in get_args(mapping)[1:] for each in members_of(value)}


Sequence_ = get_origin(Sequence[str])
_Mapping = get_origin(Mapping[str, str])


def _kinds(annotation: object) -> tuple[Kind, Kind]:
    """Return the kind of a type and the kind of its elements."""
    members = members_of(annotation)
    origins = {get_origin(member) for member in members}
    paths = {get_origin(member) or member for member in members} & {os.PathLike}
    if paths and Sequence_ not in origins:
        return Kind.PATH, Kind.PATH
    for member in members:
        if get_origin(member) is _Mapping:
            return Kind.PAIRS, Kind.NUMBER if get_args(member)[1] is float else Kind.TEXT
    for member in members:
        if get_origin(member) is Sequence_:
            return Kind.LIST, _kinds(get_args(member)[0])[0]
    for kind, python in ((Kind.FLAG, bool), (Kind.NUMBER, float), (Kind.INTEGER, int)):
        if python in members:
            return kind, kind
    return Kind.TEXT, Kind.TEXT
