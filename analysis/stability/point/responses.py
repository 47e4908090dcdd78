"""Linear model of one loop with its modes and margins, and comparison of linearised and measured responses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..loops.curves import Response, quotient
from ..loops.margin_values import LoopMargins
from ..loops.readings import decibels, factor_of
from ..results.responses import Agreement, Linearised, Measured, Mode
from .assessment import assess, lowest_frequency
from .bench import StudyError
from .lifted import UNIT_CIRCLE, LiftedModel, SampledChannel
from .linearise import Linearisation
from .modes import CoupledMemory, make_outside_mode, modes

GAIN_AGREES = factor_of(0.1)
PHASE_AGREES = np.radians(0.5)
NOT_LINEAR = 0.01  # change of L at half the amplitude
DOUBTFUL = 0.01  # change of L with the next smaller steps of the differences
LEAST_LOOK = 0.03
MOST_BLUR = 1e-3
INTEGRATOR = 0.1  # fraction of the lowest frequency: 0.002 of the lowest gain crossover
SLOW_ANGLE = np.pi / 8  # rad
# Steps of differences at a point whose plateau is known: near the cube root of the rounding of a double, where
# central differences are most accurate
ONE_STEP = (1e-5,)
BESIDE_ONE = 1e-3  # rad: poles on the unit circle at larger angles are undamped oscillations


@dataclass
class LoopModel:
    """Linearisation of one channel; ``outside`` names unstable state variables outside the loop, the fastest first."""

    model: LiftedModel
    port: SampledChannel
    modes: tuple[Mode, ...]
    poles_open: np.ndarray
    facts: Linearised
    outside: tuple[CoupledMemory, ...] = ()

    def response(self, frequency: np.ndarray) -> np.ndarray:
        return self.model.response((self.port,), frequency)[:, 0, 0]

    @cached_property
    def lowest(self) -> float:
        """Lowest frequency of the search for margins (rad/s)."""
        return lowest_frequency(self.response, self.port.seconds)

    @cached_property
    def _unstable(self) -> np.ndarray:
        """Rates (rad/s) of open-loop poles outside the unit circle; slower ones are integrators split by rounding."""
        outside = self.poles_open[abs(self.poles_open) > 1.0 + UNIT_CIRCLE].astype(complex)
        rates = abs(np.log(outside)) / self.model.period
        return rates[rates > INTEGRATOR * self.lowest]

    @property
    def unstable_open(self) -> int:
        return len(self._unstable)

    def slower(self, frequency: float) -> int:
        """Return the number of unstable open-loop poles slower than a frequency (rad/s).

        They are indistinguishable from integrators there.
        """
        return int(np.sum(self._unstable < frequency))

    @property
    def poles(self) -> np.ndarray:
        """Multipliers of the closed-loop modes that are controllable and observable at the cut."""
        return np.array([mode.z for mode in self.modes if mode.kind == "loop"])

    @property
    def has_plateau(self) -> bool:
        """True if the derivatives in the model can be trusted."""
        return self.facts.plateau <= DOUBTFUL

    @property
    def largest(self) -> float:
        """Largest multiplier of a closed-loop mode that is in the loop or, if unstable, outside; 0 without modes."""
        own = [abs(mode.z) for mode in self.modes if mode.kind == "loop"]
        return max([0.0, *own, *(float(abs(block.multipliers[0])) for block in self.outside)])

    @property
    def stable(self) -> bool:
        """True if the whole system is stable with all loops closed: no memory may grow."""
        return not self.outside and bool(self.largest < 1.0 + self.blur)

    @property
    def blur(self) -> float:
        """Distance from the unit circle below which a pole is indistinguishable from poles on the circle."""
        return _blur(self.facts.plateau)

    def lightly_damped(self) -> tuple[list[float], list[float]]:
        """Return frequencies (rad/s) of undamped and of lightly damped open-loop poles.

        If the loop has several samples in a hyperperiod, a multiplier only determines the frequency of slow poles.
        """
        angle = np.angle(self.poles_open)
        maximum = np.pi if self.port.count == 1 else SLOW_ANGLE
        oscillating = self.poles_open[(angle > BESIDE_ONE) & (angle < maximum)]
        on_circle = abs(abs(oscillating) - 1.0) <= self.blur
        frequencies = np.angle(oscillating) / self.model.period
        near = (abs(oscillating) > 0.9) & ~on_circle
        return [float(w) for w in frequencies[on_circle]], [float(w) for w in frequencies[near]]

    def margins(self) -> LoopMargins:
        """Return the nearest margins. Raises StudyError if they cannot be determined."""
        seconds = self.port.seconds
        try:
            undamped, near = self.lightly_damped()
            assessment = assess(self.response, self.lowest, np.pi / seconds, seconds, None, (), [*undamped, *near])
        except ValueError as error:
            raise StudyError(f"{self.port.channel.name}: {error}") from error
        return LoopMargins.of(assessment.classical, assessment.robust, self.stable, self.largest)


def loop_model(linearisation: Linearisation, port: SampledChannel) -> LoopModel:
    """Return the model of one channel within a linear model, and whether it can be trusted."""
    model = linearisation.model.reduce((port,))
    neighbour = linearisation.neighbour.reduce((port,))
    nyquist = np.pi / port.seconds
    look = np.geomspace(1e-3, 1.0, 40) * nyquist
    a, b = model.response((port,), look)[:, 0, 0], neighbour.response((port,), look)[:, 0, 0]
    visible = (abs(a) > LEAST_LOOK) & (abs(a) < 1.0 / LEAST_LOOK)  # margins are decided where L is about 1
    change = float(np.max(abs(b[visible] / a[visible] - 1.0), initial=linearisation.unknown))
    facts = Linearised(
        states=linearisation.states,
        period=model.period,
        plateau=change,
        doubtful=_doubtful(model, neighbour) if change > DOUBTFUL else (),
        periodicity=model.periodicity(port, look[::8]),
    )
    own = modes(model, port)
    outside = tuple(block for block in linearisation.blocks if _is_outside(block, own, change))
    place = linearisation.model.ports.index(port)
    unseen = tuple(
        make_outside_mode(complex(block.multipliers[0]), model.period, block.moved[place], block.moves[place])
        for block in outside
        if not any(_equals_fastest(mode, block) for mode in own)
    )
    return LoopModel(model, port, own + unseen, model.open_loops((port,)), facts, outside)


def _blur(change: float) -> float:
    return max(UNIT_CIRCLE, min(10.0 * change, MOST_BLUR))


def _is_outside(block: CoupledMemory, own: Sequence[Mode], plateau: float) -> bool:
    """Return True if a block grows, and no mode of the loop accounts for it."""
    if abs(block.multipliers[0]) < 1.0 + _blur(max(block.change, plateau)):
        return False
    return not any(mode.kind == "loop" and _equals_fastest(mode, block) for mode in own)


def _equals_fastest(mode: Mode, block: CoupledMemory) -> bool:
    """Return True if a mode equals the fastest mode of a block, up to the effect of memory that reduction omitted."""
    return bool(abs(abs(mode.z) - abs(block.multipliers[0])) < MOST_BLUR)


def _doubtful(model: LiftedModel, neighbour: LiftedModel) -> tuple[str, ...]:
    """Return the memory cells whose derivatives change most with the step."""
    if model.a.shape != neighbour.a.shape:
        return ("the dependencies of outputs on inputs depend on the step",)
    change = np.max(abs(model.a - neighbour.a), axis=0)
    worst = np.argsort(-change)[:5]
    return tuple(model.names[place] for place in worst if change[place] > 0.0)


def agreement(response: Response, measured: Measured, sample_period: float) -> Agreement:
    """Compare linearised and measured response on the measured lines below half the Nyquist frequency."""
    highest = 0.5 * np.pi / sample_period
    retained = measured.curve.frequency <= highest
    frequency = measured.curve.frequency[retained]
    ratio = quotient(measured.curve.value[retained], response(frequency))
    with np.errstate(divide="ignore"):
        gain = float(np.exp(np.max(abs(np.log(abs(ratio))))))
    phase = float(np.max(abs(np.angle(ratio))))
    return Agreement(gain, phase, float(frequency[-1]), bool(gain <= GAIN_AGREES and phase <= PHASE_AGREES))


def disagreement(compared: Agreement, a: Linearised, b: Measured) -> str:
    """Return the reason for different linearised and measured responses, as far as either method shows it."""
    reasons = []
    if a.plateau > DOUBTFUL:
        names = ", ".join(a.doubtful)
        reasons.append(f"the derivatives of the linearisation depend on the difference step ({a.plateau:.2g}; {names})")
    if b.half_amplitude_change > NOT_LINEAR:
        reasons.append(f"L changes by {b.half_amplitude_change:.2g} when the amplitude is halved")
    if b.unexcited > NOT_LINEAR:
        reasons.append(f"the response at unexcited lines is {b.unexcited:.2g} times the response at excited lines")
    if a.periodicity > NOT_LINEAR:
        reasons.append(
            f"the loop is periodically time-varying (a fraction {a.periodicity:.2g} of the signal "
            "returns at other frequencies)"
        )
    size = f"{decibels(compared.gain):.2g} dB and {np.degrees(compared.phase):.2g} deg apart"
    return f"{size}: " + (
        "; ".join(reasons) or "neither method shows a reason, so the operating point may change during the measurement"
    )
