"""All verbs, in the order of `perilune --help`."""

from __future__ import annotations

from .flights import RUN
from .verb import Verb

PURPOSES = ("Simulate", "Study", "Look", "Make", "Share")  # headings of `perilune --help`
VERBS: dict[str, Verb] = {verb.name: verb for verb in (RUN,)}
