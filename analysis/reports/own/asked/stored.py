"""Numbers that were computed before and lie with the system, against which a budget is drawn up."""

from __future__ import annotations

import json
import math

from lxml import etree

from .signal_reader import SignalReader
from .stages import StoredBound


def read_bound(reader: SignalReader, element: etree._Element, name: str) -> StoredBound:
    """The numbers by name in a JSON file of the system's archive, {"values": {...}}; none where it is not there."""
    archive = reader.prepared.archive
    if name not in archive.files:
        return StoredBound({}, f"{name} does not lie with the system")
    try:
        values = json.loads(archive.read(name, "bound"))["values"]
        found = {str(key): float(value) for key, value in values.items()}
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise reader.refuse(
            element, f'bound {name} is not JSON of the form {{"values": {{...}}}}', "make it again"
        ) from error
    for key, value in found.items():
        if not math.isfinite(value):
            raise reader.refuse(element, f"bound {name}: {key} is not finite", "make it again")
    return StoredBound(found)
