"""A campaign and all files that it extends as one list of values, each with its file and line."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

from ..campaigns.definition.campaign_source import read_source
from ..campaigns.definition.file import parse_campaign
from ..campaigns.definition.table import TomlTable
from ..runtime.ssp.archive import open_system

PLAIN_KEY = re.compile(r"[A-Za-z0-9_-]+")


def describe_campaign(system: str, campaign: str) -> dict[str, Any]:
    """Describe a campaign of a system, or a campaign file. Raises InputError.

    ``files`` are the campaign's file and the files that it extends. ``values`` are the merged entries in the order of
    reading: ``name`` (the full TOML key), ``value``, ``file``, ``line``.
    """
    archive = open_system(system)
    raw, label = archive.campaign(campaign)
    source = read_source(raw, label, archive)
    table = source.table()
    declared = parse_campaign(table)
    return {
        "campaign": campaign,
        "system": declared.system,
        "description": declared.description,
        "variants": [variant.name for variant in declared.variants()],
        "files": [_file(each.label) for each in source.files()],
        "values": list(_values(table, table.content, "", "")),
    }


def toml_value(value: Any) -> str:
    """Return a number, text, list or mapping as a TOML value."""
    if isinstance(value, Mapping):
        inside = ", ".join(f"{_key(name)} = {toml_value(each)}" for name, each in value.items())
        return f"{{ {inside} }}" if inside else "{}"
    if isinstance(value, list):
        return f"[{', '.join(map(toml_value, value))}]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)  # TOML uses the same escapes as JSON
    return str(value).lower() if isinstance(value, bool) else repr(value)


def _values(table: TomlTable, content: Mapping[str, Any], path: str, name: str) -> Iterator[dict[str, Any]]:
    for key, value in content.items():
        inner, full = f"{path}.{key}" if path else key, f"{name}.{_key(key)}" if name else _key(key)
        if isinstance(value, Mapping) and value:
            yield from _values(table, value, inner, full)
        else:
            file, line = table.origin(inner)
            yield {"name": full, "value": value, "file": _file(file), "line": line}


def _key(name: str) -> str:
    return name if PLAIN_KEY.fullmatch(name) else json.dumps(name, ensure_ascii=False)


def _file(label: str) -> str:
    """Return the path of a file within the system's folder (``campaigns/NAME.toml``), or its full path."""
    return label.rpartition("!")[2]
