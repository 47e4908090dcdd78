"""The few margins that are followed while something else is changed."""

from __future__ import annotations

import numpy as np

from .loops.margin_values import Margins
from .point.assessment import assess, lowest_frequency
from .point.bench import StudyError
from .point.linearise import Linearisation
from .point.responses import LoopModel, loop_model

ONE_STEP = (1e-6,)  # of differences, where a plateau has been seen at the same point already


def model_of(linear: Linearisation, name: str) -> LoopModel:
    """The loop of one channel in a linear model."""
    return loop_model(linear, next(port for port in linear.model.ports if port.channel.name == name))


def margins_of(model: LoopModel) -> Margins:
    """The nearest margins of one loop. Raises StudyError where they cannot be read."""
    seconds = model.port.seconds
    low = lowest_frequency(model.response, seconds)
    try:
        undamped, near = model.lightly_damped()
        assessment = assess(model.response, low, np.pi / seconds, seconds, None, (), [*undamped, *near])
    except ValueError as error:
        raise StudyError(f"{model.port.channel.name}: {error}") from error
    return Margins.of(assessment.classical, assessment.robust, model.stable, model.largest)


def poles_of(model: LoopModel) -> np.ndarray:
    """The multipliers of the closed-loop modes that the cut moves and sees."""
    return np.array([mode.z for mode in model.modes if mode.kind == "loop"])
