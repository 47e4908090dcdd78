"""Bound of a system's landing, computed once and stored in its folder with the hash of its inputs.

This module needs no solvers: a page can show a bound, or report that it is missing, without them.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from ....common.atomic import write_atomically
from ....common.errors import InputError
from ...runtime.system.prepared import PreparedSystem
from .declared_bound import Inputs, read_inputs

PLACE = "extra/bound.json"  # in the folder, and so in the .ssp
FIELDS = ("propellant", "duration", "intervals", "burns", "pieces", "sha256", "inputs")


@dataclass(frozen=True)
class StoredBound:
    """Stored bound on the propellant of a landing, with its inputs.

    ``propellant`` (kg) and ``duration`` (s) refer to a single-burn braking and landing, computed on a number of
    ``intervals``; ``burns`` contains begin and end (s) of each burn at full thrust. ``pieces`` contains the propellant
    (kg) of each phase into which the SSD divides the landing, by name. ``inputs`` are in SI units, with their hash.
    """

    propellant: float
    duration: float
    intervals: int
    burns: tuple[tuple[float, float], ...]
    pieces: Mapping[str, float]
    sha256: str
    inputs: Inputs


@dataclass(frozen=True)
class MissingBound:
    """Reason why there is no bound to show, and the remedy."""

    reason: str


def digest(inputs: Inputs) -> str:
    """Return the SHA-256 hash of the inputs by name, which depends on every bit of their numbers."""
    return hashlib.sha256(json.dumps(_plain(inputs), sort_keys=True).encode()).hexdigest()


def find_bound(prepared: PreparedSystem) -> StoredBound | MissingBound | None:
    """Return the bound stored for the values of a prepared system, None if its SSD declares no bound.

    Raises InputError for an invalid file.
    """
    inputs = read_inputs(prepared)
    if inputs is None:
        return None
    remedy = f"store the bound with perilune design bound {prepared.archive.name}"
    if PLACE not in prepared.archive.files:
        return MissingBound(f"no {PLACE} in the system; {remedy}")
    bound = read_bound(prepared.archive.read(PLACE, PLACE), f"{prepared.archive.label}/{PLACE}")
    if bound.sha256 != digest(inputs):
        names = dict.fromkeys([*inputs, *bound.inputs])
        other = [name for name in names if bound.inputs.get(name) != inputs.get(name)]
        return MissingBound(f"{PLACE} was computed for different values of {', '.join(other)}; {remedy}")
    return bound


def read_bound(content: bytes, file: str) -> StoredBound:
    """Return a stored bound. Raises InputError for any other file, or one whose hash does not match its inputs."""
    remedy = "store the bound again with perilune design bound"
    try:
        document = json.loads(content)
    except ValueError as error:
        raise InputError(file, "", f"not JSON: {error}", remedy) from error
    if not isinstance(document, dict) or sorted(document) != sorted(FIELDS):
        raise InputError(file, "", f"its keys are not {', '.join(FIELDS)}", remedy)
    try:
        bound = StoredBound(
            propellant=_positive(document["propellant"]),
            duration=_positive(document["duration"]),
            intervals=int(document["intervals"]),
            burns=tuple((float(begin), float(end)) for begin, end in document["burns"]),
            pieces={str(name): _positive(value) for name, value in document["pieces"].items()},
            sha256=str(document["sha256"]),
            inputs={
                str(name): tuple(map(float, value)) if isinstance(value, list) else float(value)
                for name, value in document["inputs"].items()
            },
        )
    except (TypeError, ValueError, AttributeError) as error:
        raise InputError(file, "", f"not a bound: {error}", remedy) from error
    if bound.sha256 != digest(bound.inputs):
        raise InputError(file, "sha256", "does not match the inputs", remedy)
    return bound


def write_bound(bound: StoredBound, folder: Path) -> Path:
    """Write the bound into a system's folder, and return the path."""
    path = folder / PLACE
    document = asdict(bound) | {"inputs": _plain(bound.inputs)}
    write_atomically(path, (json.dumps(document, indent=1, allow_nan=False) + "\n").encode())
    return path


def _plain(inputs: Inputs) -> dict[str, object]:
    return {name: list(value) if isinstance(value, tuple) else value for name, value in inputs.items()}


def _positive(value: float | str) -> float:
    number = float(value)
    if not (math.isfinite(number) and number > 0.0):
        raise ValueError(f"{value} is not a positive number")
    return number
