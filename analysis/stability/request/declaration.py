"""Declarations of a stability study: operating points, loops, elements, sweeps, limits."""

from __future__ import annotations

from dataclasses import dataclass, field

from ...runtime.system.options import Layer
from ..loops.margin_values import MarginQuantity


@dataclass(frozen=True)
class MarginLimits:
    """Least margins that pass; gains in dB and phases in deg, as they are specified and shown."""

    gain_margin_db: float = 6.0
    phase_margin_deg: float = 30.0
    modulus_margin: float = 0.5
    dispersed_gain_margin_db: float = 3.0
    dispersed_phase_margin_deg: float = 20.0

    @property
    def nominal(self) -> dict[MarginQuantity, float]:
        """Limits for one loop."""
        return {
            MarginQuantity.GAIN: self.gain_margin_db,
            MarginQuantity.PHASE: self.phase_margin_deg,
            MarginQuantity.MODULUS: self.modulus_margin,
        }


@dataclass(frozen=True)
class PointDeclaration:
    """Operating point of a linearisation: the first multiple of the hyperperiod at or after ``time`` (s).

    ``signal`` and ``falls_to`` replace ``time`` by the first communication point at which the signal is at most this
    value. ``layer`` are the system options of the operating point. ``until`` (s) limits measurements; None: unlimited.
    ``phase`` describes the activity of the system at the point.
    """

    name: str
    time: float | None = None
    signal: str | None = None
    falls_to: float | None = None
    until: float | None = None
    phase: str = ""
    layer: Layer = field(default_factory=Layer)


@dataclass(frozen=True)
class NonlinearElement:
    """Nonlinear element at a loop's cut: the kind and parameters of its describing function.

    ``layer`` changes the operating point for the simulation with which a predicted limit cycle is compared: it selects
    the FMUs or values with which the element acts. With an empty layer there is no simulation.
    """

    name: str
    kind: str
    parameters: dict[str, float]
    layer: Layer = field(default_factory=Layer)


@dataclass(frozen=True)
class LoopDeclaration:
    """Loop and its ``cut``: a connector, or a vector of connectors, each of which is a channel.

    With ``direction``, a vector of three connectors, the cut is the connector ``cut`` (a magnitude) times
    ``direction``, with the channels x, y, z; with ``direction_rate`` the direction is extrapolated by ``ahead`` (s).
    ``returned`` is the return signal, unless this is the cut itself; it has as many components as the cut. ``period``
    (s) is the loop's sample period; None: every communication point. ``amplitude`` of the injected signal is in the
    cut's unit; None: 1 % of the signal. ``points`` are names of operating points.
    """

    name: str
    cut: str
    points: tuple[str, ...]
    direction: str | None = None
    direction_rate: str | None = None
    ahead: float = 0.0
    returned: str | None = None
    period: float | None = None
    amplitude: float | None = None
    elements: tuple[NonlinearElement, ...] = ()


@dataclass(frozen=True)
class Sweep:
    """Margins of one loop's first channel at one point, over a parameter from ``low`` to ``high``."""

    name: str
    loop: str
    point: str
    parameter: str
    low: float
    high: float


@dataclass(frozen=True)
class Declaration:
    """All declarations of a system for its stability study."""

    limits: MarginLimits = MarginLimits()
    points: tuple[PointDeclaration, ...] = ()
    loops: tuple[LoopDeclaration, ...] = ()
    sweeps: tuple[Sweep, ...] = ()

    @property
    def layers(self) -> tuple[Layer, ...]:
        """System options that operating points and elements change."""
        elements = (element.layer for loop in self.loops for element in loop.elements)
        return (*(point.layer for point in self.points), *elements)
