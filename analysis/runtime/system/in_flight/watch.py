"""How flights are watched, whatever flies: their time on the wall clock, what their FMUs say."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ....common.errors import InputError, suggestion

LOG_LEVELS = ("error", "warning", "info", "all")
# The least fmi2Status of each level: discard, warning, OK; of `all` FMUs are asked for all their categories, too.
SAID_FROM = dict(zip(LOG_LEVELS, (2, 1, 0, 0), strict=True))


@dataclass(frozen=True)
class Watch:
    """``timeout`` (s of the wall clock) ends a flight, ``log`` is the least level of messages that are written.

    Raises InputError for a time that is not positive, and a level that is none.
    """

    timeout: float | None = None
    log: str | None = None

    def __post_init__(self) -> None:
        if self.timeout is not None and not 0.0 < self.timeout < math.inf:
            raise InputError("`timeout`", str(self.timeout), "not a positive number of seconds", "give more than 0")
        if self.log is not None and self.log not in LOG_LEVELS:
            raise InputError("`log`", self.log, "no such level", suggestion(self.log, LOG_LEVELS))


UNWATCHED = Watch()
