"""Recorded simulations inside the page of a batch: signals over time, and a common scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import TypedDict

import numpy as np

from .....common.errors import InputError
from ....campaigns.execute.campaign_result import CampaignResult
from ....campaigns.folder.provenance import CampaignProvenance
from ...common.colours import COLOURS
from ...common.quantities import display_factor, display_unit
from ...common.signals import vector_of
from ...figures.figure_reader import read_figures
from ...figures.scene.scene_elements import SceneFigure
from ...scene.flights import FlightsView, RecordedFlight, flights_view
from ...scene.poses import signals_of
from ..campaign.recorded_names import axis_of, is_real, names_of_record, unit_of
from .recorded_flights import choose_flights, read_flights

LINE_LIMIT = 24  # signals of a flight


class PanelLine(TypedDict):
    """A signal in a panel, with its colour."""

    name: str
    colour: str


class FlightsPanel(TypedDict):
    """A panel over time; its numbers are in SI units, and ``factor`` converts them to ``unit``."""

    title: str
    unit: str
    factor: float
    steps: bool
    lines: list[PanelLine]


class FlightColumns(TypedDict):
    """A recorded trial: its time (s), and a column for each line of the panels."""

    variant: str
    trial: int
    time: np.ndarray
    columns: list[np.ndarray]


class RecordedDocument(TypedDict):
    """Recorded simulations over time: panels with lines, and the columns of each simulation."""

    panels: list[FlightsPanel]
    flights: list[FlightColumns]


@dataclass(frozen=True)
class EmbeddedFlights:
    """Recorded simulations for scripts: ``document``, the ``scene`` if there is one, and sentences about both."""

    document: RecordedDocument
    scene: FlightsView | None
    notes: list[str]


def embedded_flights(batch: CampaignResult) -> EmbeddedFlights | None:
    """Return the recorded simulations of a batch for its page, or None if it recorded none."""
    chosen = choose_flights(batch)
    if not chosen:
        return None
    notes = []
    scene = None
    try:
        scene = _declared_scene(batch)
    except InputError as error:  # the page is written without a scene
        notes.append(f"The system's scene cannot be read: {error}.")
    usable = names_of_record(batch.provenance)
    plotted = usable[:LINE_LIMIT]
    flights, stride = read_flights(batch, chosen, {*plotted, *_scene_names(scene)})
    if not flights:
        return None
    plotted = [name for name in plotted if all(name in each.flight.signals for each in flights)]
    traced = sum(len(rows.traced()) for rows in batch.rows.values())
    notes.insert(
        0, f"{len(flights)} of {traced} trials with recorded signals; half of them are failures if there are enough."
    )
    if len(usable) > LINE_LIMIT:
        notes.append(f"Plotted are the first {LINE_LIMIT} of {len(usable)} signals.")
    if stride > 1:
        notes.append(f"Plotted are one in {stride} recorded rows of each signal, and the last row.")
    return EmbeddedFlights(
        document=_document(batch.provenance, plotted, flights),
        scene=None if scene is None else flights_view(scene, flights),
        notes=notes,
    )


def _declared_scene(batch: CampaignResult) -> SceneFigure | None:
    """Return the scene declared by the system of the first variant. Raises InputError."""
    prepared = batch.plan.prepare(next(iter(batch.plan.campaign.variants())))
    return next((figure for figure in read_figures(prepared) if isinstance(figure, SceneFigure)), None)


def _scene_names(scene: SceneFigure | None) -> set[str]:
    bodies = () if scene is None else scene.bodies
    sites = () if scene is None else scene.sites
    poses = [part for body in bodies for part in (body.position, body.attitude)]
    return set().union(*map(signals_of, poses), *map(signals_of, sites))


def _document(
    provenance: CampaignProvenance, names: Sequence[str], flights: Sequence[RecordedFlight]
) -> RecordedDocument:
    """Return the document of flights: a panel per vector with a line per element, and the samples of every flight."""
    panels = [(base, list(lines)) for base, lines in groupby(names, key=vector_of)]
    return {
        "panels": [
            {
                "title": base,
                "unit": display_unit(unit_of(provenance, lines[0])),
                "factor": display_factor(unit_of(provenance, lines[0])),
                "steps": not is_real(provenance, lines[0]),
                "lines": [
                    {"name": axis_of(provenance, name) or name, "colour": COLOURS[index % len(COLOURS)]}
                    for index, name in enumerate(lines)
                ],
            }
            for base, lines in panels
        ],
        "flights": [
            {
                "variant": each.name.variant,
                "trial": each.name.trial,
                "time": each.flight.time,
                "columns": [each.flight.signals[name] for name in names],
            }
            for each in flights
        ],
    }
