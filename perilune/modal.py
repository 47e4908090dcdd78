"""Poles placed by formula: state feedback, output feedback, observers, pulses. See docs/modal_synthesis.md.

Signs: `place` and its kin return K of **u = -K x**, `place_derivative` K of **u = -K x'**, `output_feedback` and its
kin F of **u = F y**, observers L of x_h' = A x_h + B u + L (y - C x_h). All but `place_derivative` is for continuous
plants and, with multipliers as poles, for sampled ones.
"""

from __future__ import annotations

from .analysis.design.feedback.derivative import DerivativeFeedback, place_derivative
from .analysis.design.feedback.integral import IntegralFeedback, place_integral
from .analysis.design.feedback.upper_levels import output_feedback_upper
from .analysis.design.poles.observers import observer, reduced_observer
from .analysis.design.poles.output_feedback import output_feedback
from .analysis.design.poles.output_feedback_set import (
    CommonFeedback,
    OutputFeedbackSet,
    common_feedback,
    output_feedback_set,
)
from .analysis.design.poles.place import place, place_levels, place_polynomial, polynomial_of_gain
from .analysis.design.poles.polynomial import polynomial_of_solvents
from .analysis.design.poles.pulses import PulsedPlant, pulsed_step
from .analysis.design.poles.results import (
    Observer,
    OutputFeedback,
    Placement,
    PlacementError,
    Reason,
    ReducedObserver,
    StateFeedback,
)
from .analysis.design.poles.zeroth_level import output_feedback_levels
from .analysis.design.symbolic.gain import SymbolicGain, symbolic_gain, symbolic_observer

__all__ = [
    "CommonFeedback",
    "DerivativeFeedback",
    "IntegralFeedback",
    "Observer",
    "OutputFeedback",
    "OutputFeedbackSet",
    "Placement",
    "PlacementError",
    "PulsedPlant",
    "Reason",
    "ReducedObserver",
    "StateFeedback",
    "SymbolicGain",
    "common_feedback",
    "observer",
    "output_feedback",
    "output_feedback_levels",
    "output_feedback_set",
    "output_feedback_upper",
    "place",
    "place_derivative",
    "place_integral",
    "place_levels",
    "place_polynomial",
    "polynomial_of_gain",
    "polynomial_of_solvents",
    "pulsed_step",
    "reduced_observer",
    "symbolic_gain",
    "symbolic_observer",
]
