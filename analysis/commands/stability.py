"""The command that studies the stability of a system again, at one trial of the campaign of a study."""

from __future__ import annotations

from dataclasses import fields

from ..options.command import write_command
from ..options.declared.studies import STABILITY
from ..options.option import options_of
from ..runtime.system.options import SystemOptions
from ..stability.request.request import Request


def study_command(request: Request, loop: str, trial: int) -> str:
    """Return the command that studies a loop of a request at one trial of its campaign."""
    assert request.plan is not None
    assert request.campaign is not None
    settings = {each.name: getattr(request.options, each.name) for each in fields(SystemOptions)}
    campaign = request.plan.campaign
    options = {name: setting for name, setting in settings.items() if name in options_of(STABILITY.options)} | {
        "campaign": request.campaign,
        "configuration": campaign.selected,
        "trial": trial,
        **({"trials": campaign.trials} if request.draws is None else {"draws": request.draws}),
        "seed": campaign.seed,
        "loops": (loop,),
        "at": request.at,
    }
    return write_command(STABILITY, {"system": request.system}, options)
