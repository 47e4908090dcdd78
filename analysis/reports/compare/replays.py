"""Trials of the compared variants to fly again: the first failures of each, where its campaign lies in a folder."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup

from ...batch.manifest.manifest import FILE as MANIFEST
from ...batch.replay import stored_replay
from ...compare.comparison import Comparison
from ..batch.replays import FAILURES, Replay


def failures_to_replay(comparison: Comparison) -> list[Replay]:
    """The first failures of each contender, and whether the reference succeeds in that trial."""
    found: list[Replay] = []
    reference = comparison.contenders[comparison.reference].trials
    succeeds = dict(zip(reference.trial.tolist(), reference.success.tolist(), strict=True))
    for label, contender in comparison.contenders.items():
        folder, trials = contender.stored.folder, contender.trials
        if not (folder / MANIFEST).is_file():
            continue
        for row in np.flatnonzero(~trials.success)[:FAILURES]:
            trial = int(trials.trial[row])
            reasons = [Markup("{}").format(trials.statuses[row])]
            if label != comparison.reference and succeeds[trial]:
                reasons.append(Markup("{} succeeds").format(comparison.reference))
            command = stored_replay(folder, contender.stored.variants, contender.name, trial)
            found.append(Replay(label, trial, reasons, command))
    return found
