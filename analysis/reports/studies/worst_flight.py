"""The worst case flown once more with every signal, and the figures that its system asks for."""

from __future__ import annotations

from dataclasses import replace

from ...batch.flying.flyer import Flyer
from ...campaign.campaign import Record
from ...campaign.drawing.declared import drawn_names
from ...campaign.drawing.given import GivenDraws, part_streams, stream_component
from ...campaign.plan import BatchPlan
from ...flight.results import Result
from ...worst.outcome import WorstResult
from ..own.asked.declared import Figure
from ..own.asked.reading import read_figures


def worst_flight(result: WorstResult, plan: BatchPlan) -> tuple[Result, list[Figure]]:
    """The flight of the worst case with the bits of the search; ``plan`` is that of the study. Raises InputError."""
    drawn = result.flown.draws
    names = [*drawn_names(plan.campaign), *(name for name in drawn if stream_component(name) is not None)]
    given = GivenDraws(*part_streams({name: drawn[name][[result.row]] for name in names}))
    plain = replace(plan, campaign=replace(plan.campaign, record=Record(), group=None, scatters=()))
    flyer = Flyer(plain.of_samples(given))
    (variant,) = flyer.variants
    flight, _ = flyer.replay(variant, 0)
    return flight, read_figures(plain.prepare(flyer.variants[variant]))
