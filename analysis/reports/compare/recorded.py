"""What a stored batch kept over time, sorted into quantities by names and units alone; nothing is of one system."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...campaigns.compare.comparison import Contender
from ...campaigns.folder.stored import StoredBatch
from ..common.signals import INDEXED

Signals = Mapping[str, np.ndarray]

COMMANDS = ("thrust_acceleration", "thrust", "delivered_thrust", "thrust_angle", "throttle")
DIRECTIONS = ("thrust_direction", "attitude")
MOTION = ("altitude", "speed", "path_angle", "mass")
CONSISTENCY = ("normalised_error_square",)
RATIO = "_error_ratio"
KINDS = {
    **dict.fromkeys(COMMANDS, "commands"),
    **dict.fromkeys(MOTION, "motion"),
    **dict.fromkeys(CONSISTENCY, "consistency"),
}
KNOWN = (*COMMANDS, *DIRECTIONS, *MOTION, *CONSISTENCY, "position", "velocity", "central_angle")
ALL = "all variants"
MOST_FLIGHTS = 300  # of a contender that are read: bands do not change visibly with more
MOST_ROWS = 500  # of a flight that are kept


@dataclass(frozen=True)
class Quantity:
    """A number over time: computed from ``names`` by ``values``, in SI. ``held`` between rows if not Real."""

    label: str
    variable: str
    unit: str | None
    kind: str  # commands, motion, consistency or other
    names: tuple[str, ...]
    values: Callable[[Signals], np.ndarray]
    held: bool = False


@dataclass(frozen=True)
class Flight:
    """One flight's kept signals. ``success`` is the trial's; ``is_whole`` if the last row is the flight's last."""

    trial: int
    success: bool
    time: np.ndarray
    signals: Signals
    is_whole: bool


def variable_of(batch: StoredBatch, name: str) -> str:
    """``plant.position[1]`` and ``plant.position``: ``position``."""
    variable = batch.split_rows(name)[1]
    indexed = INDEXED.fullmatch(variable)
    return indexed[1] if indexed else variable


def names_of_record(batch: StoredBatch) -> list[str]:
    """Signals over time that a page can use: those that were asked for, or of full traces the known ones.

    Of a variable that several components have, as inputs repeat outputs, the first component's is taken.
    """
    record = batch.document["record"]
    if record["every"] is not None:
        return list(record["signals"])
    if record["traces"] == "none":
        return []
    owners: dict[str, str] = {}
    retained = []
    for name in batch.document["signals"]:
        owner, variable = batch.split_rows(name)[0], variable_of(batch, name)
        known = variable in KNOWN or variable.endswith(RATIO)
        if known and owners.setdefault(variable, owner) == owner:
            retained.append(name)
    return retained


def vectors(names: Iterable[str]) -> dict[str, tuple[str, str, str]]:
    """Names of elements 1 to 3 by the vector's name, for all that have exactly these."""
    elements: dict[str, dict[str, str]] = {}
    for name in names:
        indexed = INDEXED.fullmatch(name)
        if indexed:
            elements.setdefault(indexed[1], {})[indexed[2]] = name
    return {base: (parts["1"], parts["2"], parts["3"]) for base, parts in elements.items() if set(parts) == set("123")}


def find_vector(
    batch: StoredBatch, names: Iterable[str], variable: str, unit: str, owner: str = ""
) -> tuple[str, str, str] | None:
    """The first vector called ``variable`` with that unit, if there is one of the component ``owner``."""
    candidates = {
        base: elements
        for base, elements in vectors(names).items()
        if variable_of(batch, base) == variable and _unit(batch, elements[0]) == unit
    }
    return candidates.get(f"{owner}.{variable}") or next(iter(candidates.values()), None)


def _unit(batch: StoredBatch, name: str) -> str | None:
    return batch.document["signals"].get(name, {}).get("unit")


def quantities(batch: StoredBatch) -> list[Quantity]:
    """Every quantity over time that can be drawn, in order of their signals."""
    names = names_of_record(batch)
    listed: list[Quantity] = []
    selected: set[str] = set()
    altitude = any(variable_of(batch, name) == "altitude" for name in names)
    for base, elements in vectors(names).items():
        variable = variable_of(batch, base)
        if variable in DIRECTIONS:
            listed.append(
                Quantity(f"{base} above the horizontal", variable, "rad", "commands", elements, _elevation(elements))
            )
        elif variable == "velocity":
            listed.append(
                Quantity(f"{base}, magnitude", variable, _unit(batch, elements[0]), "motion", elements, _norm(elements))
            )
        elif variable == "position" and not altitude:
            unit = _unit(batch, elements[2])
            listed.append(Quantity(elements[2], variable, unit, "motion", elements[2:], _element(elements[2])))
        elif variable != "position":
            continue
        selected |= set(elements)
    for name in names:
        if name not in selected:
            variable = variable_of(batch, name)
            held = batch.document["signals"].get(name, {}).get("type", "Real") != "Real"
            unit = _unit(batch, name)
            kind = "consistency" if variable.endswith(RATIO) else KINDS.get(variable, "other")
            listed.append(Quantity(name, variable, unit, kind, (name,), _element(name), held))
    return sorted(listed, key=lambda quantity: names.index(quantity.names[0]))


def _element(name: str) -> Callable[[Signals], np.ndarray]:
    return lambda signals: signals[name]


def _norm(names: Sequence[str]) -> Callable[[Signals], np.ndarray]:
    return lambda signals: np.linalg.norm([signals[name] for name in names], axis=0)


def _elevation(names: Sequence[str]) -> Callable[[Signals], np.ndarray]:
    x, y, z = names
    return lambda signals: np.arctan2(signals[z], np.hypot(signals[x], signals[y]))


def trials_with_traces(contenders: Iterable[Contender]) -> dict[str, list[int]]:
    """Trials of which each contender's traces are shown: those that all have; without such, each its own.

    Where signals are sampled, flights that failed and are kept in full beyond them do not count: they
    would stand for more than their share.
    """
    own: dict[str, list[int]] = {}
    for contender in contenders:
        record = contender.stored.document["record"]
        limit = record["trials"] if record["every"] is not None and record["trials"] is not None else None
        traced = contender.stored.traced[contender.name]
        own[contender.label] = [trial for trial in traced if limit is None or trial < limit]
    common = set.intersection(*map(set, own.values())) if own else set()
    displayed = {label: [trial for trial in trials if not common or trial in common] for label, trials in own.items()}
    return {label: trials[:MOST_FLIGHTS] for label, trials in displayed.items()}


def doubling(ratio: float) -> int:
    """The least power of two that is not below ``ratio``: rows thinned by such steps stay rows of each other."""
    step = 1
    while step < ratio:
        step *= 2
    return step


def read_flights(contender: Contender, trials: Iterable[int], names: Sequence[str]) -> list[Flight]:
    """The traces of some trials with those of ``names`` that they have, rows thinned where they are many."""
    number = {int(trial): row for row, trial in enumerate(contender.trials.trial)}
    flights = []
    for trial in trials:
        signals = contender.stored.trace(contender.name, trial, names)
        rows = signals["time"].size
        chosen = np.unique(np.append(np.arange(0, rows, doubling(rows / MOST_ROWS)), max(0, rows - 1)))[:rows]
        thinned = {name: values[chosen].astype(float) for name, values in signals.items()}
        time = thinned.pop("time")
        row = number[trial]
        whole = bool(time.size) and bool(time[-1] >= contender.trials.end_time[row])
        flights.append(Flight(trial, bool(contender.trials.success[row]), time, thinned, whole))
    return flights
