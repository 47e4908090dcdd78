"""Trials in a row with all that is drawn for them: values, faults, random streams."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...runtime.system.fault import Fault
from ...runtime.system.prepared import PreparedSystem
from ..draws.generators import stream_numbers
from ..draws.given import GivenDraws
from ..draws.table import DrawTable
from .campaign import Campaign
from .faults import DrawnFault


@dataclass(frozen=True)
class DrawnTrials:
    """The samples of the trials ``numbers`` of a plan with its campaign, ``given`` samples and ``user_faults``."""

    campaign: Campaign
    given: GivenDraws | None
    user_faults: Sequence[Fault]
    numbers: range
    table: DrawTable
    faults: Sequence[DrawnFault]

    def row(self, trial: int) -> dict[str, float]:
        """All drawn and derived values of a trial."""
        return self.table.row(trial - self.numbers.start)

    def faults_of(self, trial: int) -> list[Fault | None]:
        """The faults of a trial, in the order of `BatchPlan.list_faults`; None for one that does not fly in it."""
        return [*(fault.in_trial(trial - self.numbers.start) for fault in self.faults), *self.user_faults]

    def parameters(self, prepared: PreparedSystem, trial: int) -> dict[str, float | int]:
        """The parameters of a trial: draws, and seed and stream of every component that has them."""
        values: dict[str, float | int] = dict(self.table.parameters(trial - self.numbers.start))
        noisy = with_streams(prepared)
        if noisy:
            given, campaign = self.given, self.campaign
            trials = {name: trial if given is None else given.stream_of(trial, name) for name in noisy}
            streams = {
                whose: stream_numbers(campaign.seed, whose, prepared.network.fmus, campaign.file)
                for whose in set(trials.values())
            }
            for name, whose in trials.items():
                values[f"{name}.seed"], values[f"{name}.stream"] = streams[whose][name]
        return values


def with_streams(prepared: PreparedSystem) -> list[str]:
    """The components that draw random numbers themselves."""
    return [name for name, fmu in prepared.network.fmus.items() if {"seed", "stream"} <= fmu.variables.keys()]
