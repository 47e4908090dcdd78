"""The worst case flown once more with every signal, and the figures that its system asks for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...campaign.campaign import Record
from ...campaign.drawing.declared import drawn_names
from ...campaign.drawing.given import STREAMS, GivenDraws
from ...campaign.plan import BatchPlan
from ...flight.results import Result
from ...samples.recorded import fly_recorded
from ...worst.outcome import WorstResult
from ..own.asked.declared import Figure
from ..own.asked.reading import read_figures


def worst_flight(result: WorstResult, plan: BatchPlan) -> tuple[Result, list[Figure]]:
    """The flight of the worst case with the bits of the search; ``plan`` is that of the study. Raises InputError."""
    place = result.places[0]
    columns = {name: result.flown.draws[name][[place]] for name in drawn_names(plan.campaign)}
    given = GivenDraws(columns, result.flown.draws[STREAMS][[place]].astype(np.int64))
    plain = replace(plan, campaign=replace(plan.campaign, record=Record(), group=None, scatters=()))
    flight, prepared = fly_recorded(plain, given)
    return flight, read_figures(prepared)
