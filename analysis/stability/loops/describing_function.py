"""Sinusoidal-input describing functions N(a) of nonlinear elements of actuators.

An element with the input a sin(wt) has a periodic output; N(a) is the complex ratio of the fundamental of this output
to the input. With the output y(theta) for the input a sin(theta), over one cycle

    N(a) = 1/(pi a) integral of y(theta) (sin(theta) + j cos(theta)) d theta.

None of these elements depends on frequency. The imaginary part is negative if the output lags (hysteresis), and 0 if
the output depends on the current input alone. All elements are odd: the mean of the input is assumed to be 0.

Source: Gelb and Vander Velde 1968, Multiple-Input Describing Functions and Nonlinear System Design, section 2.3
(piecewise-linear elements and their saturation function f) and table B.1.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from numbers import Real

import numpy as np

Parameters = Mapping[str, float]
INPUT, OUTPUT, RATIO = "unit of the input", "unit of the output", "unit of the output per unit of the input"
INTEGRAL = "unit of the input times s"


@dataclass(frozen=True)
class ElementKind:
    """Kind of nonlinear element.

    - ``gain``: function that returns N (complex, (n,)) for positive amplitudes (n,) and complete parameters.
    - ``required``, ``optional``: parameters with their units; ``defaults`` are the values of optional parameters.
    - ``positive``: parameters that may not be 0; no parameter may be negative.
    - ``check``: function that returns the error in a combination of individually valid parameters, or "".
    - ``kinks``: function that returns the amplitudes, ascending, at which N is not smooth, up to ``farthest``.
    - ``farthest``: function that returns the amplitude above which N is practically constant (inf: N tends to 0).
    - ``output``: function that returns the largest output, inf without limit, so that abs(N) <= 4 output/(pi a).
    - ``of_integral``: True if the amplitude refers to the integral of the input over time.
    - ``note``: assumptions.
    """

    gain: Callable[[np.ndarray, Parameters], np.ndarray]
    required: Mapping[str, str]
    positive: tuple[str, ...]
    kinks: Callable[[Parameters], np.ndarray]
    note: str
    optional: Mapping[str, str] = field(default_factory=dict)
    defaults: Parameters = field(default_factory=dict)
    check: Callable[[Parameters], str] = lambda parameters: ""
    farthest: Callable[[Parameters], float] = lambda parameters: math.inf
    output: Callable[[Parameters], float] = lambda parameters: math.inf
    of_integral: bool = False


def _share(threshold: float | np.ndarray, amplitude: np.ndarray) -> np.ndarray:
    """Return sqrt(1 - (threshold/amplitude)^2) if the amplitude exceeds the threshold, else 0."""
    ratio = np.minimum(abs(threshold) / amplitude, 1.0)
    return np.sqrt((1.0 - ratio) * (1.0 + ratio))


def _saturation_function(limit: float, amplitude: np.ndarray) -> np.ndarray:
    """Return f(limit/a): N of a saturation with slope 1 (Gelb and Vander Velde 1968, section 2.3)."""
    ratio = np.minimum(limit / amplitude, 1.0)
    return 2.0 / math.pi * (np.arcsin(ratio) + ratio * _share(limit, amplitude))


def _relay(amplitude: np.ndarray, parameters: Parameters) -> np.ndarray:
    level, dead_zone, hysteresis = (parameters[name] for name in ("level", "dead_zone", "hysteresis"))
    on, off = dead_zone + hysteresis, dead_zone - hysteresis
    # the relay is on from arcsin(on/a) to pi - arcsin(off/a), and half a cycle later with the opposite sign
    real = 2.0 * level / (math.pi * amplitude) * (_share(on, amplitude) + _share(off, amplitude))
    imaginary = -4.0 * level * hysteresis / (math.pi * amplitude**2)
    return np.where(amplitude >= on, real + 1j * imaginary, 0.0)


def _quantiser(amplitude: np.ndarray, parameters: Parameters) -> np.ndarray:
    step = parameters["step"]

    def gain(a: float) -> float:
        """Return N at one amplitude: a sum of relays, each one step high, that switch halfway between levels."""
        thresholds = (np.arange(math.floor(a / step + 0.5)) + 0.5) * step
        ratio = np.minimum(thresholds / a, 1.0)
        return 4.0 * step / (math.pi * a) * float(np.sum(np.sqrt((1.0 - ratio) * (1.0 + ratio))))

    return np.array([gain(a) for a in amplitude.tolist()], dtype=complex)


def _staircase(amplitude: np.ndarray, parameters: Parameters) -> np.ndarray:
    """Return N of pulses that follow the integral of the demand in steps of a least pulse, at most one step late.

    It is a staircase of relays with thresholds one least pulse apart, each with a hysteresis of half a least pulse.
    """
    minimum = parameters["least_pulse"]

    def gain(a: float) -> complex:
        """Return N at one amplitude: half the sum over relays on both sides of 0, switched at i - 1/2 and i + 1/2."""
        steps = np.arange(-math.floor(a / minimum - 0.5), math.floor(a / minimum - 0.5) + 1) * minimum
        if not len(steps):
            return 0.0 + 0.0j
        sides = _share(steps - 0.5 * minimum, np.asarray(a)) + _share(steps + 0.5 * minimum, np.asarray(a))
        return minimum / (math.pi * a) * (float(np.sum(sides)) - 1j * len(steps) * minimum / a)

    return np.array([gain(a) for a in amplitude.tolist()], dtype=complex)


def _pulse_width(amplitude: np.ndarray, parameters: Parameters) -> np.ndarray:
    level, dead_zone, gain = (parameters[name] for name in ("level", "dead_zone", "gain"))
    # Up to the limit the mean is gain times the input. The dead zone removes a saturation at its width, minus the jump
    # at its edge, which is a relay of this height.
    linear = _saturation_function(level / gain, amplitude) - _saturation_function(dead_zone, amplitude)
    jump = 4.0 * dead_zone / (math.pi * amplitude) * _share(dead_zone, amplitude)
    return gain * (linear + jump) + 0j


def _pulse_width_check(parameters: Parameters) -> str:
    full = parameters["level"] / parameters["gain"]
    if parameters["dead_zone"] > full:
        return f"dead_zone = {parameters['dead_zone']!r} exceeds level/gain = {full!r}, the input at full pulse width"
    return ""


def _thresholds(*values: float) -> np.ndarray:
    return np.unique([value for value in values if value > 0.0])


_QUANTISER_LEVELS = 100  # N is within 1e-3 of 1 from there on
_PULSE_STEPS = 700  # N is within 1e-3 of 1 from there on
_DEAD_ZONES = 1e4  # N is within 2e-4 of 1 from there on

ELEMENTS: dict[str, ElementKind] = {
    "relay": ElementKind(
        gain=_relay,
        required={"level": OUTPUT},
        optional={"dead_zone": INPUT, "hysteresis": INPUT},
        defaults={"dead_zone": 0.0, "hysteresis": 0.0},
        positive=("level",),
        kinks=lambda parameters: _thresholds(parameters["dead_zone"] + parameters["hysteresis"]),
        output=lambda parameters: parameters["level"],
        note="on where the input leaves +-(dead_zone + hysteresis), off where it returns to within +-(dead_zone "
        "- hysteresis); without a dead zone it switches at +-hysteresis",
    ),
    "dead zone": ElementKind(
        gain=lambda amplitude, parameters: 1.0 - _saturation_function(parameters["dead_zone"], amplitude) + 0j,
        required={"dead_zone": INPUT},
        positive=("dead_zone",),
        kinks=lambda parameters: _thresholds(parameters["dead_zone"]),
        farthest=lambda parameters: _DEAD_ZONES * parameters["dead_zone"],
        note="0 within +-dead_zone, outside it the input minus the dead zone (slope 1)",
    ),
    "saturation": ElementKind(
        gain=lambda amplitude, parameters: _saturation_function(parameters["limit"], amplitude) + 0j,
        required={"limit": INPUT},
        positive=("limit",),
        kinks=lambda parameters: _thresholds(parameters["limit"]),
        output=lambda parameters: parameters["limit"],
        note="the input within +-limit (slope 1), outside it the limit",
    ),
    "quantiser": ElementKind(
        gain=_quantiser,
        required={"step": INPUT},
        positive=("step",),
        kinks=lambda parameters: (np.arange(_QUANTISER_LEVELS) + 0.5) * parameters["step"],
        farthest=lambda parameters: _QUANTISER_LEVELS * parameters["step"],
        note="the nearest whole multiple of step",
    ),
    "carried pulses": ElementKind(
        gain=_staircase,
        required={"least_pulse": INTEGRAL},
        positive=("least_pulse",),
        kinks=lambda parameters: (np.arange(_PULSE_STEPS) + 0.5) * parameters["least_pulse"],
        farthest=lambda parameters: _PULSE_STEPS * parameters["least_pulse"],
        note="pulses of at least least_pulse, with the unfired demand carried over: the amplitude is the "
        "amplitude of the demand integrated over time, and the integral of the pulses is a staircase in steps of "
        "least_pulse, at most one step behind",
        of_integral=True,
    ),
    "pulse width": ElementKind(
        gain=_pulse_width,
        required={"level": OUTPUT},
        optional={"dead_zone": INPUT, "gain": RATIO},
        defaults={"dead_zone": 0.0, "gain": 1.0},
        positive=("level", "gain"),
        check=_pulse_width_check,
        kinks=lambda parameters: _thresholds(parameters["dead_zone"], parameters["level"] / parameters["gain"]),
        output=lambda parameters: parameters["level"],
        note="quasi-static mean over a modulation period: the signal is slow compared with the period, the loop "
        "filters out the ripple, and the linear part contains the delay (of a hold); the mean is gain times the "
        "input up to level, and 0 below dead_zone = level (minimum on-time)/(gain period)",
    ),
}


def complete_parameters(kind: str, parameters: Parameters) -> dict[str, float]:
    """Return the parameters of an element as floats, including defaults. Raises ValueError with one line."""
    if kind not in ELEMENTS:
        raise ValueError(f"{kind!r} is not a kind of element; choose one of {', '.join(ELEMENTS)}")
    element = ELEMENTS[kind]
    known = {**element.required, **element.optional}
    takes = ", ".join(
        f"{name} ({unit}{', optional' if name in element.optional else ''})" for name, unit in known.items()
    )
    for name in parameters:
        if name not in known:
            raise ValueError(f"{kind} has no parameter {name!r}; it takes {takes}")
    complete: dict[str, float] = dict(element.defaults)
    for name in known:
        if name not in parameters:
            if name in element.required:
                raise ValueError(f"{kind} lacks its parameter {name!r}; it takes {takes}")
            continue
        value = parameters[name]
        if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
            raise ValueError(f"{kind}: {name} = {value!r} is not a finite number")
        if value < 0.0 or (value == 0.0 and name in element.positive):
            raise ValueError(f"{kind}: {name} = {value!r} is {'negative' if value < 0.0 else 'not above 0'}")
        complete[name] = float(value)
    problem = element.check(complete)
    if problem:
        raise ValueError(f"{kind}: {problem}")
    return complete


def describing_function(kind: str, amplitude: np.ndarray, parameters: Parameters) -> np.ndarray:
    """Return N(a), complex, for amplitudes of the input (any shape, positive); 0 if the element has no output.

    Its unit is the unit of the output divided by the unit of the input. Raises ValueError for a wrong kind, parameter
    or amplitude.
    """
    complete = complete_parameters(kind, parameters)
    values = np.asarray(amplitude, dtype=float)
    if not np.all((values > 0.0) & np.isfinite(values)):
        raise ValueError("amplitudes must be finite and positive")
    return ELEMENTS[kind].gain(values.ravel(), complete).astype(complex).reshape(values.shape)


def amplitude_range(kind: str, parameters: Parameters) -> tuple[float, float]:
    """Return the least and the greatest amplitude for a figure of N(a), around its kinks (or one level of output)."""
    complete = complete_parameters(kind, parameters)
    element = ELEMENTS[kind]
    kinks = element.kinks(complete)
    if not len(kinks):
        return 0.1 * element.output(complete), 10.0 * element.output(complete)
    return 0.5 * float(kinks[0]), 20.0 * float(kinks[0] if math.isinf(element.output(complete)) else kinks[-1])
