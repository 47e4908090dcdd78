"""One simulation of a study again, with every signal recorded."""

from __future__ import annotations

from ..batch.flying.flyer import Flyer
from ..campaign.drawing.given import GivenDraws
from ..campaign.plan import BatchPlan
from ..flight.results import Result
from ..system.prepared import PreparedSystem


def fly_recorded(plan: BatchPlan, given: GivenDraws) -> tuple[Result, PreparedSystem]:
    """The first of given draws flown with the same bits as in the study, and the system that flew. Raises InputError.

    ``plan`` is that of a study: of one variant.
    """
    flyer = Flyer(plan.of_samples(given))
    (variant,) = flyer.variants
    result, _ = flyer.replay(variant, 0)
    return result, plan.prepare(flyer.variants[variant])
