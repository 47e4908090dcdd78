"""Trials of the compared variants to fly again: the first failures of each, where its campaign lies in a folder."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup

from ...campaigns.compare.comparison import Comparison
from ...campaigns.fly.manifest.manifest import FILE as MANIFEST
from ...campaigns.replay_command import stored_replay
from ..campaign.replays import FAILURES, Replay


def failures_to_replay(comparison: Comparison) -> list[Replay]:
    """The first failures of each contender, and how many of the others succeed in that trial."""
    found: list[Replay] = []
    for label, contender in comparison.contenders.items():
        stored, trials = contender.stored, contender.trials
        if not (stored.folder / MANIFEST).is_file():
            continue
        others = [other.trials.success for name, other in comparison.contenders.items() if name != label]
        for row in np.flatnonzero(~trials.success)[:FAILURES]:
            trial = int(trials.trial[row])
            reasons = [Markup("{}").format(trials.statuses[row])]
            if others:
                count = sum(bool(success[row]) for success in others)
                reasons.append(Markup("{} of {} others succeed").format(count, len(others)))
            command = stored_replay(stored.folder, stored.variants, contender.name, trial)
            found.append(Replay(label, trial, reasons, command))
    return found
