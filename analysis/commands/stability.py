"""Command that repeats a stability study at one trial of its campaign."""

from __future__ import annotations

from ..options.command import write_command
from ..options.declared.studies import STABILITY
from ..options.option import options_of
from ..stability.request.request import Request


def study_command(request: Request, loop: str, trial: int) -> str:
    """Return the command that studies a loop of a request at one trial of its campaign."""
    assert request.plan is not None
    assert request.campaign is not None
    campaign = request.plan.campaign
    known = options_of(STABILITY.options)
    options = {name: setting for name, setting in request.options.by_name.items() if name in known} | {
        "campaign": request.campaign,
        "configuration": campaign.selected,
        "trial": trial,
        **({"trials": campaign.trials} if request.draws is None else {"draws": request.draws}),
        "seed": campaign.seed,
        "loops": (loop,),
        "at": request.at,
    }
    return write_command(STABILITY, {"system": request.system}, options)
