"""All verbs, in the order of `perilune --help`."""

from __future__ import annotations

from .campaigns import BATCH, MERGE, PREPARE, REPLAY, SHARD
from .flights import RUN
from .stability import STABILITY
from .studies import RARE, SENSITIVITY, WORST
from .verb import Verb

PURPOSES = ("Simulate", "Study", "Look", "Make", "Share")  # headings of `perilune --help`
VERBS: dict[str, Verb] = {
    verb.name: verb for verb in (RUN, BATCH, REPLAY, STABILITY, RARE, WORST, SENSITIVITY, PREPARE, SHARD, MERGE)
}
