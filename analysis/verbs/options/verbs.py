"""All verbs, in the order of `perilune --help`; verbs of two words form groups."""

from __future__ import annotations

from .campaigns import BATCH, COMPARE, MERGE, PREPARE, REPLAY, SHARD
from .flights import RUN
from .looking import DESCRIBE, LIST, VALIDATE
from .making import EXPORT, NEW_BLOCK, NEW_SYSTEM
from .stability import STABILITY
from .studies import RARE, SENSITIVITY, WORST
from .verb import Verb

PURPOSES = ("Simulate", "Study", "Look", "Make", "Share")  # headings of `perilune --help`
VERBS: dict[str, Verb] = {
    verb.name: verb
    for verb in (
        *(RUN, BATCH, REPLAY),
        *(COMPARE, STABILITY, RARE, WORST, SENSITIVITY),
        *(LIST, DESCRIBE, VALIDATE),
        *(NEW_BLOCK, NEW_SYSTEM),
        *(EXPORT, PREPARE, SHARD, MERGE),
    )
}
GROUPS: dict[str, str] = {
    "new": "write a block or a system of your own to start from"
}  # what the verbs of a group do, by its first word

# Verbs of earlier releases, and what to write for them.
RENAMED: dict[str, str] = {}

# Verbs that are not declared yet.
OLD = {
    "law": "print a network operator's law as a formula, or write it as parameter set or drawing",
    "synthesize": "search for a control law, every candidate flown in its system",
    "plan": "plan a transfer between hovers, or bound what a landing takes",
    "benchmark": "time a communication step against other importers",
}
