"""All verbs, in the order of `perilune --help`; verbs of two words form groups."""

from __future__ import annotations

from ...options.declaration import Verb
from ...options.declared.campaigns import BATCH, COMPARE, MERGE, PREPARE, REPLAY, RUN, SHARD, SHOW
from ...options.declared.library import (
    COMPOSE,
    DESCRIBE,
    DIFF,
    DOCS,
    EXPORT,
    LIST,
    NEW_BLOCK,
    NEW_SYSTEM,
    VALIDATE,
    VERIFY,
)
from ...options.declared.studies import RARE, SENSITIVITY, STABILITY, WORST
from .design import BOUND, BOUNDS, LAW, SEARCH, TRANSFER

PURPOSES = {  # headings of `perilune --help`
    "Simulate": (RUN, BATCH, REPLAY),
    "Study": (COMPARE, SHOW, DIFF, STABILITY, RARE, WORST, SENSITIVITY),
    "Inspect": (LIST, DESCRIBE, VALIDATE, VERIFY, DOCS),
    "Create": (NEW_BLOCK, NEW_SYSTEM, COMPOSE, LAW, SEARCH, TRANSFER, BOUND, BOUNDS),
    "Distribute": (EXPORT, PREPARE, SHARD, MERGE),
}
VERBS: dict[str, Verb] = {verb.name: verb for verbs in PURPOSES.values() for verb in verbs}
GROUPS = {  # first word of verbs -> purpose of the group
    "new": "write a template for your own block or system",
    "design": "design control laws, and plans of least propellant",
}

# Verbs of earlier releases, with the present name of each.
RENAMED = {
    "law": "design law",
    "synthesize": "design search",
    "plan hover-transfer": "design transfer",
    "plan landing-bound": "design bound",
    "plan": "design transfer or perilune design bound",
}
# Verbs of earlier releases that no longer exist, with the message for each.
FORMER = {old: f"renamed; write perilune {new}" for old, new in RENAMED.items()} | {
    "benchmark": "left the package; run `make bench` in a checkout of Perilune"
}
