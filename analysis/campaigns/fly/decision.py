"""Whether a campaign that ends as soon as its requirements are decided is over."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..requirement_verdicts import satisfies, trials_to_decision
from ..rows import TrialRows
from ..spec.plan import BatchPlan


class Decision:
    """Looks at the shards of a campaign in order of number, whatever the order in which they come.

    ``shards`` is how many of the first ones decide the campaign, None as long as they do not: so it depends neither on
    workers nor on what else has flown. A campaign that is not to end early is never decided.
    """

    def __init__(self, plan: BatchPlan) -> None:
        self._plan = plan
        self._ahead: dict[int, dict[str, list[np.ndarray]]] = {}  # of shards behind one that is missing
        self._kept: dict[str, list[np.ndarray]] = {}  # by variant, for each requirement
        self._looked = 0
        self.shards: int | None = None

    @property
    def is_made(self) -> bool:
        return self.shards is not None

    def add(self, shard: int, variants: Mapping[str, TrialRows]) -> None:
        """Look at the trials of a shard by variant, as soon as all before it are there."""
        if not self._plan.until_decided:
            return
        requirements = self._plan.campaign.requirements
        self._ahead[shard] = {
            name: [satisfies(requirement, trials) for requirement in requirements] for name, trials in variants.items()
        }
        while not self.is_made and self._looked in self._ahead:
            for name, rows in self._ahead.pop(self._looked).items():
                before = self._kept.get(name)
                self._kept[name] = (
                    rows if before is None else [np.concatenate(both) for both in zip(before, rows, strict=True)]
                )
            self._looked += 1
            if trials_to_decision(requirements, self._kept) is not None:
                self.shards = self._looked
