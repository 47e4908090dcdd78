"""What the two methods to a loop's response find, and how far each can be trusted. Times in s, frequencies in rad/s."""

from __future__ import annotations

from dataclasses import dataclass

from ..loops.readings import Curve


@dataclass(frozen=True)
class Mode:
    """A closed-loop mode over the ``period`` (s) of the linear model.

    ``z`` is the multiplier over one period, ``s`` the equivalent log(z)/period (rad/s; not unique above the
    Nyquist frequency of the period). ``kind`` is "loop" for modes that the cut can both move and see, else
    "not controllable", "not observable" or "neither". ``controllability`` and ``observability`` are the sizes of
    the mode's input and output vectors, scaled by the largest.
    """

    z: complex
    s: complex
    damping: float
    frequency: float
    kind: str
    controllability: float
    observability: float


@dataclass(frozen=True)
class Structure:
    """Ranks of the controllability and observability Gramians' factors and their smallest kept singular values."""

    states: int  # of the complete memory
    order: int  # of the part that the cut both moves and is moved by
    controllable: int
    observable: int
    least_controllable: float
    least_observable: float


@dataclass(frozen=True)
class Linearised:
    """How the Jacobian was made and how far it can be trusted."""

    states: int
    period: float  # s, over which the Jacobian was taken
    plateau: float  # largest relative change of a column between neighbouring steps of the difference
    doubtful: tuple[str, ...]  # memory whose columns have no plateau: kinks, switches
    periodicity: float  # largest share of the response that comes back at other frequencies; 0: time-invariant


@dataclass(frozen=True)
class Measured:
    """How the injection was made and how far it can be trusted."""

    amplitude: float  # of one line, in the cut's unit
    lines: int
    periods: int
    period: float  # s, of the multisine
    half_amplitude_change: float  # largest relative change of L between full and half amplitude
    unexcited: float  # largest response on unexcited lines relative to the excited ones': nonlinearity, noise
    curve: Curve


@dataclass(frozen=True)
class Agreement:
    """The largest difference of the two methods below half the Nyquist frequency."""

    gain: float  # factor, at least 1
    phase: float  # rad
    frequency: float  # rad/s, highest that was compared
    agrees: bool
