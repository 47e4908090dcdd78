"""All verbs, in the order of `perilune --help`; verbs of two words form groups."""

from __future__ import annotations

from .flights import RUN
from .looking import DESCRIBE, LIST, VALIDATE
from .verb import Verb

PURPOSES = ("Simulate", "Study", "Look", "Make", "Share")  # headings of `perilune --help`
VERBS: dict[str, Verb] = {verb.name: verb for verb in (RUN, LIST, DESCRIBE, VALIDATE)}
GROUPS: dict[str, str] = {}  # what the verbs of a group do, by its first word

# Verbs of earlier releases, and what to write for them.
RENAMED: dict[str, str] = {}

# Verbs that are not declared yet.
OLD = {
    "batch": "fly a campaign: many trials, variants compared on the same draws",
    "shard": "fly some shards of a campaign that perilune batch --prepare, or a batch that ended early, has left",
    "replay": "fly a trial of a stored campaign again, of its folder alone, with all signals",
    "merge": "put the flown shards of a campaign together: summary, page, requirements",
    "rare": "the probability of a rare failure over a campaign's draws, and the most probable draws that make it",
    "worst": "the draws within a campaign's box that make a number worst",
    "compare": "compare the variants of one or several stored batches on the same trials",
    "law": "print a network operator's law as a formula, or write it as parameter set or drawing",
    "synthesize": "search for a control law, every candidate flown in its system",
    "plan": "plan a transfer between hovers, or bound what a landing takes",
    "stability": "report on the stability of a system's loops",
    "benchmark": "time a communication step against other importers",
    "new": "write a block or a system of your own to start from",
    "export": "build an FMU, or a self-contained .ssp of a system, for a chosen platform",
}
