"""Conversion of results to JSON: frozen dataclasses become objects with their fields in order."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import field, fields, is_dataclass
from enum import Enum
from typing import Any

OMITTED = "omitted where empty"


def optional(default: Any = None) -> Any:
    """Declare a dataclass field that JSON omits if it is None or an empty mapping; the default {} is copied."""
    if isinstance(default, dict):
        return field(default_factory=dict, metadata={OMITTED: True})
    return field(default=default, metadata={OMITTED: True})


def to_json(value: Any) -> Any:
    """Return dataclasses, mappings and sequences as JSON; infinite numbers become "inf" and "-inf"."""
    if is_dataclass(value):
        entries = {each: getattr(value, each.name) for each in fields(value)}
        return {
            each.name: to_json(entry)
            for each, entry in entries.items()
            if not (each.metadata.get(OMITTED) and entry in (None, {}))
        }
    if isinstance(value, Mapping):
        return {str(key): to_json(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [to_json(entry) for entry in value]
    if isinstance(value, Enum):
        return value.value
    return str(value) if isinstance(value, float) and math.isinf(value) else value
