"""Content of a `system.toml` as plain values, and the function that reads it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ...common.bounds import CAMPAIGN_BYTES, XML_BYTES
from ...common.errors import InputError
from ...common.regular import read_input
from ...fmus_src.export.ssp_package import SYSTEM_FILE
from ...fmus_src.units import BASE_UNITS
from ..campaigns.definition.campaign_source import key_lines, parse_toml
from ..campaigns.definition.table import TomlTable, integer, names, number, text
from ..runtime.ssp.conversions import Unit
from ..runtime.ssp.parameter_values import ParameterValue

ANNOTATIONS_FILE = "annotations.xml"
KINDS = ("input", "output", "parameter")  # of system connectors
LISTS = ("connections", "declare", "unconnected")
TOP = (
    "name",
    "description",
    "start_time",
    "stop_time",
    "step",
    "parameters",
    "annotations",
    *LISTS,
    "components",
    "system",
    "set",
    "units",
)
# A scalar, the elements of a vector or matrix in row-major order, or the rows of a matrix.
SetValue = ParameterValue | Sequence[ParameterValue] | Sequence[Sequence[ParameterValue]]
COMPONENT_NAME = re.compile(r"[^\s.,\[\]>]+")


@dataclass(frozen=True)
class ListEntry:
    """An entry of a list with its position in the file."""

    text: str
    where: str


@dataclass(frozen=True)
class ComponentSource:
    """A component: its FMU (name or path), its parameter sets, and its step in s (None: the step of the system)."""

    fmu: str
    parameters: tuple[str, ...] = ()
    step: float | None = None
    where: str = ""


@dataclass(frozen=True)
class SystemSource:
    """A system as described by its `system.toml`. Times are in s.

    ``connectors`` maps the names of the system's connectors to their kinds. ``declare`` lists unused connectors of
    components to be declared in the SSD, and ``unconnected`` lists inputs that keep the start value of their FMU.
    ``set`` contains values of parameters in their variables' units, and ``annotations`` the exact bytes inside
    ssd:Annotations.
    """

    name: str
    components: Mapping[str, ComponentSource]
    connections: tuple[ListEntry, ...] = ()
    description: str = ""
    start_time: float = 0.0
    stop_time: float | None = None
    step: float | None = None
    parameters: tuple[str, ...] = ()
    connectors: Mapping[str, str] = field(default_factory=dict)
    declare: tuple[ListEntry, ...] = ()
    unconnected: tuple[ListEntry, ...] = ()
    set: Mapping[str, SetValue] = field(default_factory=dict)
    units: Mapping[str, Unit] = field(default_factory=dict)
    annotations: bytes = b""
    file: str = SYSTEM_FILE

    @property
    def parameter_sets(self) -> list[str]:
        """The names of all parameter sets of the system and its components."""
        inner = (name for component in self.components.values() for name in component.parameters)
        return list(dict.fromkeys((*self.parameters, *inner)))

    def problem(self, where: str, problem: str, remedy: str) -> InputError:
        """Return the error for a position in the file."""
        return InputError(self.file, where, problem, remedy)


def read_source(path: Path) -> tuple[SystemSource, bytes]:
    """Return the content of a `system.toml`, and the bytes of the file followed by the bytes of its annotations.

    Raises InputError.
    """
    label = str(path)
    raw = read_input(path, "give the path of a system.toml", CAMPAIGN_BYTES)
    table = TomlTable(parse_toml(raw, label), label)
    lines = _Lines(raw.decode("utf-8"))
    table.only(TOP)
    system = table.table("system")
    system.only((*KINDS, "connections"))
    annotations = b""
    if "annotations" in table.content:
        file = path.parent / table.get("annotations", text)
        annotations = read_input(file, "correct `annotations` of the system.toml, or add the file", XML_BYTES)
    source = SystemSource(
        name=table.get("name", text),
        components=dict(_components(table.table("components"), lines)),
        connections=(*_entries(table, "connections", lines), *_entries(system, "connections", lines)),
        description=table.get("description", text, ""),
        start_time=table.get("start_time", number, 0.0),
        stop_time=table.get("stop_time", number, None),
        step=table.get("step", _positive, None),
        parameters=_list(table, "parameters"),
        connectors=_connectors(system),
        declare=_entries(table, "declare", lines),
        unconnected=_entries(table, "unconnected", lines),
        set=dict(_set(table.table("set"))),
        units=dict(_units(table.table("units"))),
        annotations=annotations,
        file=label,
    )
    return source, raw + annotations


class _Lines:
    """Line numbers of keys and list entries."""

    def __init__(self, content: str) -> None:
        self.texts = content.splitlines()
        self.keys = key_lines(content)

    def of_key(self, key: str) -> str:
        """Return a key with its line number appended, if known."""
        return f"{key} (line {self.keys[key]})" if key in self.keys else key

    def of_entries(self, key: str, texts: tuple[str, ...]) -> Iterator[ListEntry]:
        """Yield the entries of a list, each with its line number; the entries must be in the order of the file."""
        index = self.keys.get(key, 1) - 1
        for each in texts:
            index = next((i for i in range(index, len(self.texts)) if each in self.texts[i]), index)
            yield ListEntry(each, f"{key} (line {index + 1})")


def _entries(table: TomlTable, key: str, lines: _Lines) -> tuple[ListEntry, ...]:
    return tuple(lines.of_entries(f"{table.element}.{key}".lstrip("."), _list(table, key)))


def _list(table: TomlTable, key: str) -> tuple[str, ...]:
    return table.get(key, names) if key in table.content else ()


def _components(table: TomlTable, lines: _Lines) -> Iterator[tuple[str, ComponentSource]]:
    if not table.content:
        raise table.error("", "no components", 'write [components], and NAME = "FMU" below it')
    for name, stated in table.content.items():
        where = lines.of_key(f"components.{name}")
        if not COMPONENT_NAME.fullmatch(name):
            raise table.error(
                name, "not a valid component name", "write a name without dots, commas, brackets and spaces"
            )
        if isinstance(stated, dict):
            entry = table.table(name)
            entry.only(("fmu", "parameters", "step"))
            step = entry.get("step", _positive, None)
            yield name, ComponentSource(entry.get("fmu", text), _list(entry, "parameters"), step, where)
        else:
            yield name, ComponentSource(table.get(name, text), where=where)


def _connectors(table: TomlTable) -> dict[str, str]:
    kinds: dict[str, str] = {}
    for kind in KINDS:
        for name in _list(table, kind):
            if name in kinds:
                raise table.error(kind, f"{name} is also listed under {kinds[name]}", "list each variable once")
            kinds[name] = kind
    return kinds


def _set(table: TomlTable) -> Iterator[tuple[str, SetValue]]:
    for name, setting in table.flat():
        rows = setting if isinstance(setting, list) else [setting]
        for each in (each for row in rows for each in (row if isinstance(row, list) else [row])):
            if not isinstance(each, int | float):
                problem = f"{each!r} is neither a number nor true or false"
                raise table.error(name, problem, "write a number, true or false, a list of these, or a list of rows")
        yield name, setting  # type: ignore[misc]


def _units(table: TomlTable) -> Iterator[tuple[str, Unit]]:
    for name in table.content:
        entry = table.table(name)
        entry.only((*BASE_UNITS, "factor", "offset"))
        exponents = tuple(entry.get(base, integer, 0) for base in BASE_UNITS)
        unit = Unit(name, exponents, entry.get("factor", number, 1.0), entry.get("offset", number, 0.0))
        if not unit.factor:
            raise entry.error("factor", "a factor of 0 cannot convert values", "give a factor other than 0")
        yield name, unit


def _positive(table: TomlTable, key: str, value: object) -> float:
    read = number(table, key, value)
    if read <= 0.0:
        raise table.error(key, f"{value!r} is not a positive number of seconds", "give more than 0")
    return read
