"""The few margins that are followed while something else is changed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .assessment import assess, decibel, degrees, lowest_frequency
from .bench import StudyError
from .linearise import Linearisation
from .routes import loop_model

ONE_STEP = (1e-6,)  # of differences, where a plateau has been seen at the same point already


@dataclass(frozen=True)
class Margins:
    """Factors and angles (rad) as in `results`, inf where there is no crossing; ``poles`` are those of the loop."""

    gain: float
    phase: float
    modulus: float
    disk: float
    stable: bool
    poles: np.ndarray

    @property
    def gain_db(self) -> float:
        return decibel(self.gain) if np.isfinite(self.gain) else np.inf

    @property
    def phase_deg(self) -> float:
        return degrees(self.phase) if np.isfinite(self.phase) else np.inf


def margins_of(linear: Linearisation, name: str) -> Margins:
    """The margins of one channel of a linear model. Raises StudyError where they cannot be read."""
    port = next(port for port in linear.model.ports if port.channel.name == name)
    model = loop_model(linear, port)
    low = lowest_frequency(model.response, port.seconds)
    try:
        undamped, near = model.lightly_damped()
        found = assess(model.response, low, np.pi / port.seconds, port.seconds, None, (), [*undamped, *near])
    except ValueError as error:
        raise StudyError(f"{name}: {error}") from error
    gain, phase = found.classical.gain_margin, found.classical.phase_margin
    return Margins(
        gain=gain.value if gain else np.inf,
        phase=phase.value if phase else np.inf,
        modulus=found.robust.modulus_margin,
        disk=found.robust.disk_margin,
        stable=model.stable,
        poles=np.array([mode.z for mode in model.modes if mode.kind == "loop"]),
    )
