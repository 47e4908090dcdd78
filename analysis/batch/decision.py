"""Whether a campaign that ends as soon as its requirements are decided is over."""

from __future__ import annotations

from collections.abc import Mapping

from ..campaign.plan import BatchPlan
from .trials import Trials, joined
from .verdicts import decided_after


class Decision:
    """Looks at the shards of a campaign in order of number, whatever the order in which they come.

    ``parts`` are the trials of each by variant, to which others add; ``shards`` is how many of the first ones decide
    the campaign, None as long as they do not: so it depends neither on workers nor on what else has flown.
    """

    def __init__(self, plan: BatchPlan, parts: Mapping[int, Mapping[str, Trials]]) -> None:
        self._plan = plan
        self._parts = parts
        self._looked = 0
        self.shards: int | None = None
        self.is_made()

    def is_made(self) -> bool:
        """Look at the shards that follow without a gap; whether one of them is the last that is needed."""
        while self._plan.until_decided and self.shards is None and self._looked in self._parts:
            self._looked += 1
            first = [self._parts[shard] for shard in range(self._looked)]
            variants = {variant: joined(part[variant] for part in first) for variant in first[0]}
            if decided_after(self._plan.campaign.requirements, variants) is not None:
                self.shards = self._looked
        return self.shards is not None

    def trials(self) -> dict[str, Trials]:
        """The trials of the shards that decide it, or else of all that there are, by variant."""
        kept = [self._parts[shard] for shard in sorted(self._parts) if self.shards is None or shard < self.shards]
        return {variant: joined(part[variant] for part in kept) for variant in (kept[0] if kept else ())}
