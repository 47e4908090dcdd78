"""Recorded signals of a stored batch, sorted into quantities by names and units only, for any system."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .....campaigns.compare.campaign_comparison import Contender
from .....campaigns.folder.provenance import CampaignProvenance
from ...campaign.recorded_names import (
    COMMANDS,
    CONSISTENCY,
    DIRECTIONS,
    MOTION,
    RATIO,
    is_real,
    names_of_record,
    unit_of,
    variable_of,
    vectors,
)

Signals = Mapping[str, np.ndarray]

KINDS = {
    **dict.fromkeys(COMMANDS, "commands"),
    **dict.fromkeys(MOTION, "motion"),
    **dict.fromkeys(CONSISTENCY, "consistency"),
}
ALL = "all variants"
MOST_FLIGHTS = 300  # simulations read per variant; more would not visibly change the bands
MOST_ROWS = 500  # rows read per simulation


@dataclass(frozen=True)
class FlightQuantity:
    """A scalar over time, which ``values`` computes from the signals ``names``, in SI.

    ``held`` is True if it is constant between rows, as Integers and Booleans are.
    """

    label: str
    variable: str
    unit: str | None
    kind: str  # commands, motion, consistency or other
    names: tuple[str, ...]
    values: Callable[[Signals], np.ndarray]
    held: bool = False


@dataclass(frozen=True)
class ComparedFlight:
    """Recorded signals of a trial; ``is_whole`` is True if the last recorded row is the end of the simulation."""

    trial: int
    success: bool
    time: np.ndarray
    signals: Signals
    is_whole: bool


def quantities(document: CampaignProvenance) -> list[FlightQuantity]:
    """Return all quantities over time that can be drawn, in order of their signals."""
    names = names_of_record(document)
    listed: list[FlightQuantity] = []
    selected: set[str] = set()
    altitude = any(variable_of(document, name) == "altitude" for name in names)
    for base, elements in vectors(names).items():
        variable = variable_of(document, base)
        if variable in DIRECTIONS:
            listed.append(
                FlightQuantity(
                    f"{base} above the horizontal", variable, "rad", "commands", elements, _elevation(elements)
                )
            )
        elif variable == "velocity":
            listed.append(
                FlightQuantity(
                    f"{base}, magnitude", variable, unit_of(document, elements[0]), "motion", elements, _norm(elements)
                )
            )
        elif variable == "position" and not altitude:
            unit = unit_of(document, elements[2])
            listed.append(FlightQuantity(elements[2], variable, unit, "motion", elements[2:], _element(elements[2])))
        elif variable != "position":
            continue
        selected |= set(elements)
    for name in names:
        if name not in selected:
            variable = variable_of(document, name)
            held = not is_real(document, name)
            unit = unit_of(document, name)
            kind = "consistency" if variable.endswith(RATIO) else KINDS.get(variable, "other")
            listed.append(FlightQuantity(name, variable, unit, kind, (name,), _element(name), held))
    return sorted(listed, key=lambda quantity: names.index(quantity.names[0]))


def _element(name: str) -> Callable[[Signals], np.ndarray]:
    return lambda signals: signals[name]


def _norm(names: Sequence[str]) -> Callable[[Signals], np.ndarray]:
    return lambda signals: np.linalg.norm([signals[name] for name in names], axis=0)


def _elevation(names: Sequence[str]) -> Callable[[Signals], np.ndarray]:
    x, y, z = names
    return lambda signals: np.arctan2(signals[z], np.hypot(signals[x], signals[y]))


def trials_with_traces(contenders: Iterable[Contender]) -> dict[str, list[int]]:
    """Return the trials of each variant to display over time: common trials if there are any, else all.

    If the campaign records a sample of trials, failed trials recorded in addition are ignored, since they would be
    overrepresented.
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
    """Return the least power of two not below ``ratio``; records thinned by such steps have common rows."""
    step = 1
    while step < ratio:
        step *= 2
    return step


def read_flights(contender: Contender, trials: Iterable[int], names: Sequence[str]) -> list[ComparedFlight]:
    """Return the traces of some trials with the available signals of ``names``, thinned if they have many rows."""
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
        flights.append(ComparedFlight(trial, bool(contender.trials.success[row]), time, thinned, whole))
    return flights
