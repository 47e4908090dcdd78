"""The worst case flown once more with every signal, and the figures that its system asks for."""

from __future__ import annotations

from dataclasses import replace

from ...campaigns.draws.declared import input_names
from ...campaigns.draws.given import GivenDraws, part_streams, stream_component
from ...campaigns.fly.flyer import Flyer
from ...campaigns.spec.campaign import Record
from ...campaigns.spec.plan import BatchPlan
from ...runtime.flight.results import Result
from ...studies.worst.outcome import WorstResult
from ..figures.declared import Figure
from ..figures.reading import read_figures


def worst_flight(result: WorstResult, plan: BatchPlan) -> tuple[Result, list[Figure]]:
    """The flight of the worst case with the bits of the search; ``plan`` is that of the study. Raises InputError."""
    plotted = result.flown.draws
    names = [*input_names(plan.campaign), *(name for name in plotted if stream_component(name) is not None)]
    given = GivenDraws(*part_streams({name: plotted[name][[result.row]] for name in names}))
    plain = replace(plan, campaign=replace(plan.campaign, record=Record(), group=None, scatters=()))
    flyer = Flyer(plain.of_samples(given))
    (variant,) = flyer.variants
    flight, _ = flyer.replay(variant, 0)
    return flight, read_figures(plain.prepare(flyer.variants[variant]))
