"""Systems of tiny FMUs with exactly known loops: users' blocks, descriptions, loop gains.

A plant's block steps by its closed form over a hold, the loop gain next to it comes from python-control's zero-order
hold of the continuous plant: the two are independent of each other.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import control
import numpy as np
from scipy.optimize import brentq

from tests.support.builders import component, connection, document, inline, pack, system
from tests.support.loops.sampled_loops import delay, held


def with_stability(ssd: str, inside: str) -> str:
    """Return the description with an annotation around the elements of Stability, on separate lines."""
    note = (
        '<ssd:Annotations><ssc:Annotation type="org.perilune.stability">\n'
        f'<Stability xmlns="https://perilune.org/stability">\n{inside}\n</Stability>\n'
        "</ssc:Annotation></ssd:Annotations>"
    )
    end = "</ssd:SystemStructureDescription>"
    return ssd.replace(end, f"{note}\n{end}")


@dataclass(frozen=True)
class ExactSystem:
    """A description with one declared loop, and that loop's gain L by python-control (channels of ``cut`` in order).

    ``period`` (s) is the loop's; ``step`` (s) the communication step.
    """

    name: str
    ssd: str
    loop: control.StateSpace
    step: float

    @property
    def period(self) -> float:
        return float(self.loop.dt)

    def packed(self, folder: Path, fmus: Path) -> Path:
        return pack(folder / f"{self.name}.ssp", fmus, self.ssd)

    @property
    def closed(self) -> np.ndarray:
        """Closed-loop poles, largest first."""
        loop = self.loop
        feedback = np.linalg.solve(np.eye(loop.ninputs) + loop.D, loop.C)
        poles = np.linalg.eigvals(loop.A - loop.B @ feedback)
        return poles[np.argsort(-abs(poles), kind="stable")]


def held_late(plant: control.StateSpace, period: float, late: float) -> control.StateSpace:
    """Return a plant after a hold whose output acts ``late`` (s) later, less than ``period``.

    Source: Åström and Wittenmark 1997, Computer-Controlled Systems, section 3.2.
    """
    if late == 0.0:
        return control.c2d(plant, period, "zoh")
    old, new = (control.c2d(plant, part, "zoh") for part in (late, period - late))
    states, inputs = plant.nstates, plant.ninputs
    a = np.block([[new.A @ old.A, new.A @ old.B], [np.zeros((inputs, states + inputs))]])
    b = np.vstack([new.B, np.eye(inputs)])
    c = np.hstack([plant.C, np.zeros((plant.noutputs, inputs))])
    return control.ss(a, b, c, 0.0, period)


def difference(proportional: float, derivative: float, period: float) -> control.StateSpace:
    """Return proportional + derivative (1 - 1/z)/period."""
    rate = derivative / period
    return control.ss(0.0, 1.0, -rate, proportional + rate, period)


def wires(*names: str) -> str:
    """Return connections around a ring: each name ``component.input.output`` feeds the next one's input."""
    parts = [name.split(".") for name in names]
    pairs = zip(parts, [*parts[1:], parts[0]], strict=True)
    return "".join(connection(f"{here}.{out}", f"{there}.{into}") for (here, _, out), (there, into, _) in pairs)


def ring(
    parts: dict[str, tuple[str, str, str, str]], step: float, stop: float, stability: str = "", width: int = 1
) -> str:
    """Describe components in a ring: name -> (fmu, input, output, parameters), vectors of ``width``."""
    marks = [""] if width == 1 else [f"[{index}]" for index in range(1, width + 1)]
    components = [
        component(
            name,
            fmu,
            "; ".join(f"input {into}{mark} Real; output {out}{mark} Real" for mark in marks),
            inline(values) if values else "",
        )
        for name, (fmu, into, out, values) in parts.items()
    ]
    around = "".join(
        wires(*(f"{name}.{into}{mark}.{out}{mark}" for name, (_, into, out, _) in parts.items())) for mark in marks
    )
    ssd = document(system(*components, connections=around), stop=stop, step=step)
    return with_stability(ssd, stability) if stability else ssd


def stability_of(period: float | None, time: float) -> str:
    """Declare one loop, cut after its controller, at one point; ``period`` (s) None: it passes at every step."""
    rate = f'period="{period}"' if period is not None else ""
    return f'<Point name="there" time="{time}"/>\n<Loop name="loop" cut="control.y" points="there" {rate}/>'


def sampling(every: int, step: float) -> tuple[float, float | None, str]:
    """Return period of control (s), as declared and as a parameter: at every step, or at every n-th."""
    period = every * step
    return (period, period, f"; sample_period=Real:{period}") if every > 1 else (period, None, "")


def late_double_integrator(
    every: int = 1, step: float = 0.25, proportional: float = 0.02, derivative: float = 0.22
) -> ExactSystem:
    """Return proportional and derivative control of 1/s^2 over three steps of delay; control at every n-th step."""
    samples, kp, kd = 3, proportional, derivative
    period, declared, sampled = sampling(every, step)
    parts = {
        "control": ("difference", "u", "y", f"proportional=Real:{kp}; derivative=Real:{kd}{sampled}"),
        "late": ("late", "u", "y", f"samples=Integer:{samples}"),
        "plant": ("held_mass", "u", "position", ""),
    }
    whole, remainder = divmod(samples, every)
    plant = held_late(control.ss(control.tf(1.0, [1.0, 0.0, 0.0])), period, remainder * step)
    loop = difference(kp, kd, period) * plant
    if whole:
        loop = loop * delay(whole, period)
    return ExactSystem("late_double_integrator", ring(parts, step, 60.0, stability_of(declared, 20.0)), loop, step)


def resonance(every: int = 1, step: float = 0.1) -> ExactSystem:
    """Return a resonance after a low pass, of third order: the gain is above 1 around the resonance only."""
    rate, damping, gain = 2.0, 0.1, 0.5
    keep = 0.5 if every == 1 else 0.7
    period, declared, sampled = sampling(every, step)
    parts = {
        "control": ("low_pass", "u", "y", f"keep=Real:{keep}; gain=Real:{gain}{sampled}"),
        "plant": ("held_resonance", "u", "position", f"rate=Real:{rate}; damping=Real:{damping}"),
    }
    filtered = control.ss(keep, 1.0 - keep, gain * keep, gain * (1.0 - keep), period)
    plant = control.tf(rate**2, [1.0, 2.0 * damping * rate, rate**2])
    ssd = ring(parts, step, 40.0, stability_of(declared, 4.0))
    return ExactSystem("resonance", ssd, filtered * held(plant, period), step)


def pendulum(every: int = 1, step: float = 0.05) -> ExactSystem:
    """Return an upright pendulum, unstable, over one step of delay."""
    rate, kp, kd = 1.2, 4.0, 2.6
    period, declared, sampled = sampling(every, step)
    parts = {
        "control": ("difference", "u", "y", f"proportional=Real:{kp}; derivative=Real:{kd}{sampled}"),
        "late": ("late", "u", "y", "samples=Integer:1"),
        "plant": ("held_pendulum", "u", "position", f"rate=Real:{rate}"),
    }
    plant = control.ss(control.tf(1.0, [1.0, 0.0, -(rate**2)]))
    law = difference(kp, kd, period)
    loop = law * held_late(plant, period, step) if every > 1 else law * held(plant, period) * delay(1, period)
    return ExactSystem("pendulum", ring(parts, step, 30.0, stability_of(declared, 3.0)), loop, step)


def coupled_pair(every: int = 1, step: float = 0.1) -> ExactSystem:
    """Return two coupled double integrators with a controller for each."""
    coupling, kp, kd = 0.4, (0.5, 0.9), (0.9, 1.3)
    period, declared, sampled = sampling(every, step)
    gains = "; ".join(f"proportional[{i}]=Real:{kp[i - 1]}; derivative[{i}]=Real:{kd[i - 1]}" for i in (1, 2))
    parts = {
        "control": ("difference_pair", "u", "y", gains + sampled),
        "plant": ("held_pair", "u", "position", f"coupling=Real:{coupling}"),
    }
    zero, one = np.zeros((2, 2)), np.eye(2)
    into = np.array([[1.0, coupling], [-coupling, 1.0]])
    plant = control.ss(np.block([[zero, one], [zero, zero]]), np.vstack([zero, into]), np.hstack([one, zero]), zero)
    both = control.append(*(difference(p, d, period) for p, d in zip(kp, kd, strict=True)))
    ssd = ring(parts, step, 30.0, stability_of(declared, 2.0), width=2)
    return ExactSystem("coupled_pair", ssd, both * held(plant, period), step)


def relay_loop(relay: Path) -> ExactSystem:
    """Return a lead, a relay with dead zone, a delay and a double integrator; a unit gain in the relay's slot.

    A flight with ``relay``, an FMU, starts far above the unstable limit cycle; ``loop`` is the linear rest.
    """
    step, samples, gain, lead, lag = 0.25, 16, 0.01, 20.0, 2.0
    parts = {
        "lead": ("tustin_lead", "u", "y", f"gain=Real:{gain}; lead=Real:{lead}; lag=Real:{lag}"),
        "jets": ("unit_gain", "u", "y", ""),
        "late": ("late", "u", "y", f"samples=Integer:{samples}"),
        "plant": ("held_mass", "u", "position", "start=Real:5.97"),
    }
    stability = (
        '<Point name="rest" time="0"/>\n'
        '<Loop name="relay" cut="lead.y" points="rest" amplitude="0.01">\n'
        '<Element name="jets" kind="relay" level="0.06" dead_zone="0.02">\n'
        f'<Use component="jets" fmu="{relay}"/></Element></Loop>'
    )
    compensator = control.c2d(control.ss(control.tf([gain * lead, gain], [lag, 1.0])), step, "bilinear")
    plant = held(control.tf(1.0, [1.0, 0.0, 0.0]), step)
    loop = compensator * plant * delay(samples, step)
    return ExactSystem("relay_loop", ring(parts, step, 1800.0, stability), loop, step)


def end_of_stability(low: float = 1.2, high: float = 2.0) -> float:
    """Return the derivative gain (s) from which on the late double integrator is unstable, by python-control."""

    def largest(gain: float) -> float:
        return np.max(abs(late_double_integrator(derivative=gain).closed)) - 1.0

    return float(brentq(largest, low, high, rtol=1e-9))
