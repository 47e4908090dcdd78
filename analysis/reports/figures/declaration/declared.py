"""All figures that a system can ask for."""

from __future__ import annotations

from .histories import Band, Curve, Error, Path, Pulses
from .stages import Budget, Limits, Phases
from .values import Undrawn

Figure = Band | Pulses | Error | Curve | Path | Phases | Limits | Budget | Undrawn
