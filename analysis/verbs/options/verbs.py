"""All verbs, in the order of `perilune --help`; verbs of two words form groups."""

from __future__ import annotations

from .campaigns import BATCH, MERGE, PREPARE, REPLAY, SHARD
from .flights import RUN
from .looking import DESCRIBE, LIST, VALIDATE
from .stability import STABILITY
from .studies import RARE, SENSITIVITY, WORST
from .verb import Verb

PURPOSES = ("Simulate", "Study", "Look", "Make", "Share")  # headings of `perilune --help`
VERBS: dict[str, Verb] = {
    verb.name: verb
    for verb in (
        *(RUN, BATCH, REPLAY, STABILITY, RARE, WORST, SENSITIVITY, PREPARE, SHARD, MERGE),
        *(LIST, DESCRIBE, VALIDATE),
    )
}
GROUPS: dict[str, str] = {}  # what the verbs of a group do, by its first word

# Verbs of earlier releases, and what to write for them.
RENAMED: dict[str, str] = {}

# Verbs that are not declared yet.
OLD = {
    "compare": "compare the variants of one or several stored batches on the same trials",
    "law": "print a network operator's law as a formula, or write it as parameter set or drawing",
    "synthesize": "search for a control law, every candidate flown in its system",
    "plan": "plan a transfer between hovers, or bound what a landing takes",
    "benchmark": "time a communication step against other importers",
    "new": "write a block or a system of your own to start from",
    "export": "build an FMU, or a self-contained .ssp of a system, for a chosen platform",
}
