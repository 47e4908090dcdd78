"""Function that writes a `system.toml`."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator

from ...fmus_src.units import BASE_UNITS
from .source import ANNOTATIONS_FILE, KINDS, ComponentSource, SystemSource

BARE = re.compile(r"[A-Za-z0-9_-]+")
LONGEST = 100  # characters of a list on one line


def write_toml(source: SystemSource) -> str:
    """Return the text of a `system.toml`; its annotations are a separate file, ANNOTATIONS_FILE."""
    return "\n".join(_lines(source)) + "\n"


def _lines(source: SystemSource) -> Iterator[str]:
    yield f"name = {_text(source.name)}"
    if source.description:
        yield f"description = {_text(source.description)}"
    yield from ([f"start_time = {_number(source.start_time)}"] if source.start_time else [])
    for key, number in (("stop_time", source.stop_time), ("step", source.step)):
        yield from ([] if number is None else [f"{key} = {_number(number)}"])
    yield from _list("parameters", source.parameters)
    yield from ([f"annotations = {_text(ANNOTATIONS_FILE)}"] if source.annotations else [])
    yield from _list("connections", (each.text for each in source.connections))
    yield from _list("declare", (each.text for each in source.declare))
    yield from _list("unconnected", (each.text for each in source.unconnected))
    yield from ("", "[components]")
    for name, component in source.components.items():
        yield f"{_key(name)} = {_component(component)}"
    if source.connectors:
        yield from ("", "[system]")
        for kind in KINDS:
            yield from _list(kind, (name for name, each in source.connectors.items() if each == kind))
    if source.set:
        yield from ("", "[set]")
        yield from (f"{_text(name)} = {json.dumps(setting)}" for name, setting in source.set.items())
    if source.units:
        yield from ("", "[units]")
        for name, unit in source.units.items():
            sizes = [(base, str(size)) for base, size in zip(BASE_UNITS, unit.exponents or (), strict=True) if size]
            sizes += [("factor", repr(unit.factor))] if unit.factor != 1.0 else []
            sizes += [("offset", repr(unit.offset))] if unit.offset else []
            yield f"{_key(name)} = {_table(sizes)}"


def _component(component: ComponentSource) -> str:
    if not component.parameters and component.step is None:
        return _text(component.fmu)
    entries = [("fmu", _text(component.fmu))]
    entries += [("parameters", f"[{', '.join(map(_text, component.parameters))}]")] if component.parameters else []
    entries += [] if component.step is None else [("step", _number(component.step))]
    return _table(entries)


def _table(entries: Iterable[tuple[str, str]]) -> str:
    inner = ", ".join(f"{key} = {text}" for key, text in entries)
    return f"{{ {inner} }}" if inner else "{}"


def _list(key: str, texts: Iterable[str]) -> list[str]:
    quoted = [_text(each) for each in texts]
    line = f"{key} = [{', '.join(quoted)}]"
    if not quoted:
        return []
    return [line] if len(line) <= LONGEST else [f"{key} = [", *(f"    {each}," for each in quoted), "]"]


def _key(name: str) -> str:
    return name if BARE.fullmatch(name) else _text(name)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _number(number: float) -> str:
    return repr(number).removesuffix(".0")
