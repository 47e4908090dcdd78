"""Reports of stability studies made from systems of python-control: curves and numbers belong together.

Two loops about a double integrator (an attitude loop every 0.25 s, a translation loop every 8 s, each with a lead and
a sample of delay), the first with a relay, the second dispersed; a guidance loop of which only a measured response
is known. Gains, periods and leads are those of a robot of 1000 kg.
"""

import math
import warnings
from dataclasses import replace

import control
import numpy as np

from analysis.stability.results import (
    Agreement,
    AmplitudePoint,
    Classical,
    Crossing,
    Curve,
    Dispersion,
    JointReport,
    LimitCycle,
    LoopReport,
    Mode,
    Nonlinearity,
    PointReport,
    Requirement,
    Robust,
    RouteA,
    RouteB,
    Sampled,
    StabilityReport,
    Structure,
    SweepReport,
)

LEVEL, DEAD_ZONE = 1.0, 0.05  # of the relay
DIGEST = "0123456789abcdef" * 4
COMMAND = "perilune run robot_rendezvous --replay out/campaign --trial {}"


def open_loop(gain, lead, lag, period, delay=1):
    """Double integrator with hold, lead by Tustin's rule, and a delay in samples; python-control, discrete."""
    plant = control.c2d(control.tf([1], [1, 0, 0]), period, "zoh")
    law = control.c2d(control.tf([lead, 1], [lag, 1]), period, "tustin")
    return gain * plant * law * control.tf([1], [1] + [0] * delay, period)


def classical(system):
    """Every crossing, as python-control finds them."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it says when it takes a grid of frequencies instead of polynomials
        gains, phases, _, at_gain, at_phase, _ = control.stability_margins(system, returnall=True)
    phases = np.radians(phases)
    delays = [math.inf, *(phase % (2 * math.pi) / at for phase, at in zip(phases, at_phase, strict=True))]
    least = int(np.argmin(delays))
    return Classical(
        tuple(Crossing(float(value), float(at)) for value, at in zip(gains, at_gain, strict=True) if value > 1e-6),
        tuple(Crossing(float(value), float(at)) for value, at in zip(phases, at_phase, strict=True)),
        float(delays[least]),
        float(at_phase[least - 1]) if least else math.nan,
        0,
    )


def robust(curve):
    sensitivity = 1.0 / (1.0 + curve.value)
    sizes = [np.abs(sensitivity), np.abs(1.0 - sensitivity), np.abs(sensitivity - 0.5)]
    s, t, disk = (int(np.argmax(size)) for size in sizes)
    alpha = float(1.0 / sizes[2][disk])
    gain = (2 + alpha) / (2 - alpha) if alpha < 2 else math.inf
    return Robust(
        float(1.0 / sizes[0][s]), float(sizes[0][s]), float(curve.frequency[s]), float(sizes[1][t]),
        float(curve.frequency[t]), alpha, gain, 2 * math.atan(alpha / 2),
        float(curve.frequency[disk]),
    )  # fmt: skip


def curve_of(system, low=3e-4, points=900):
    nyquist = math.pi / system.dt
    frequency = np.geomspace(low * nyquist, nyquist, points)
    return Curve(frequency, np.asarray(system(np.exp(1j * frequency * system.dt))))


def required(found, distances, gain=6.0, phase=30.0):
    decibels = None if found.gain_margin is None else abs(20.0 * math.log10(found.gain_margin.value))
    degrees = None if found.phase_margin is None else math.degrees(abs(found.phase_margin.value))
    return (
        Requirement("gain margin", decibels, gain, "dB", decibels is None or decibels >= gain),
        Requirement("phase margin", degrees, phase, "deg", degrees is None or degrees >= phase),
        Requirement("modulus margin", distances.modulus_margin, 0.5, "1", distances.modulus_margin >= 0.5),
    )


def measured(curve, lines=24):
    """What an injection would give: some lines, here with an error of a part in a thousand."""
    rows = np.unique(np.geomspace(30, curve.frequency.size - 1, lines).astype(int))
    error = 1.0 + 1e-3 * np.exp(1j * np.arange(rows.size))
    return Curve(curve.frequency[rows], curve.value[rows] * error)


def linear_loop(name, system, point, **more):
    """A loop of which everything linear is known."""
    curve = curve_of(system)
    found, distances = classical(system), robust(curve)
    closed = control.feedback(system, 1)
    poles = np.append(closed.poles(), 0.35)  # a filter that the cut does not move
    period = system.dt
    modes = []
    for z in poles:
        s = np.log(complex(z)) / period if z else complex(-math.inf)
        size = abs(s)
        damping = float(-s.real / size) if math.isfinite(size) else math.nan
        modes.append(
            Mode(complex(z), complex(s), damping, float(size), "not controllable" if z == 0.35 else "loop", 0.4, 1.0)
        )
    time, response = control.step_response(closed, np.arange(0, 160) * period)
    values = {
        "name": f"{name} at {point}",
        "loop": name,
        "point": point,
        "cut": f"{name}_control.command[0]",
        "returned": f"{name}_control.command[0]",
        "unit": "N.m" if name == "attitude" else "N",
        "sample_period": period,
        "closed": ("attitude", "translation", "gyro rates"),
        "sign": "negative feedback: L is minus the transfer from the cut around to it",
        "curve": curve,
        "classical": found,
        "robust": distances,
        "stable": bool(np.all(np.abs(closed.poles()) < 1.0)),
        "unstable_open": 0,
        "modes": tuple(modes),
        "poles_z": np.asarray(poles, dtype=complex),
        "structure": Structure(41, 5, 6, 5, 3.2e-4, 1.8e-3),
        "route_a": RouteA(41, period, 2.1e-7, (), 3e-9),
        "route_b": RouteB(1e-4, 24, 4, 4096 * period, 4.2e-4, 3.1e-6, measured(curve)),
        "agreement": Agreement(1.0012, 1.1e-3, float(curve.frequency[-1] / 2), True),
        "step": (np.asarray(time), np.asarray(response)),
        "requirements": required(found, distances),
        "sampling": (
            Sampled(period / 2, found.gain_margin.value * 1.3, found.phase_margin.value * 1.1),
            Sampled(period, found.gain_margin.value, found.phase_margin.value),
            Sampled(2 * period, None, None, "no multiple of the sensor's period: the description is refused"),
        ),
    }
    return LoopReport(**(values | more))


def relay_gain(amplitude):
    """N(a) of a relay with dead zone: 4 M/(pi a) sqrt(1 - (d/a)^2)."""
    inside = np.maximum(1.0 - (DEAD_ZONE / amplitude) ** 2, 0.0)
    return 4.0 * LEVEL / (math.pi * amplitude) * np.sqrt(inside) + 0j


def relay(system):
    """The relay in the loop: cycles where N(a) is the gain margin; what is simulated is a flight of the samples."""
    crossing = classical(system).gain_margin
    half = math.pi * crossing.value / (4.0 * LEVEL)  # sqrt(1/a^2 - d^2/a^4) = half: a quadratic in 1/a^2
    roots = np.sqrt(1.0 / np.roots([DEAD_ZONE**2, -1.0, half**2]).real)
    period = 2 * math.pi / crossing.frequency
    simulated = simulate(system)
    amplitude = np.geomspace(1.0002 * DEAD_ZONE, 40 * DEAD_ZONE, 200)
    cycles = (
        LimitCycle(float(min(roots)), period, False, None, None),
        LimitCycle(float(max(roots)), period, True, *simulated),
    )
    note = "Holds as far as L filters the harmonics."
    parameters = {"level": LEVEL, "dead_zone": DEAD_ZONE}
    return Nonlinearity("jets", "relay", parameters, "rad", amplitude, relay_gain(amplitude), cycles, note)


def simulate(system, steps=4000):
    """Amplitude and period (s) of the relay's oscillation: a flight of the loop, sample by sample."""
    model = control.tf2ss(system)
    state, found = np.full(model.nstates, 0.0), np.zeros(steps)
    command = LEVEL
    for k in range(steps):
        found[k] = (model.C @ state).item()
        if k > 3:
            command = -LEVEL * math.copysign(1.0, found[k]) if abs(found[k]) > DEAD_ZONE else 0.0
        state = model.A @ state + model.B[:, 0] * command
    last = found[steps // 2 :]
    crossings = np.flatnonzero((last[1:] >= 0.0) & (last[:-1] < 0.0))
    period = float(np.mean(np.diff(crossings))) * system.dt
    return float(np.ptp(last) / 2), period


def dispersion(make, trials=80):
    """Margins with a gain and a lead drawn anew in every trial."""
    draws = np.random.default_rng(4).normal(size=(trials, 2))
    found = []
    for gain, lead in draws:
        system = make(math.exp(0.25 * gain), math.exp(0.2 * lead))
        margins, distances = classical(system), robust(curve_of(system, points=250))
        found.append((margins, distances, control.feedback(system, 1).poles()))
    gains = [np.nan if item.gain_margin is None else item.gain_margin.value for item, *_ in found]
    phases = [np.nan if item.phase_margin is None else item.phase_margin.value for item, *_ in found]
    disks = np.array([item.disk_margin for _, item, _ in found])
    poles = np.concatenate([item for *_, item in found])
    worst = int(np.argmin(disks))
    least_gain = min(abs(20.0 * math.log10(value)) for value in gains)
    least_phase = math.degrees(min(abs(value) for value in phases))
    return Dispersion(
        "campaigns/margins.toml", trials, np.array(gains), np.array(phases),
        np.array([item.modulus_margin for _, item, _ in found]), disks,
        np.array([bool(np.all(np.abs(item) < 1.0)) for *_, item in found]), poles, worst, COMMAND.format(worst),
        (
            Requirement("gain margin", least_gain, 3.0, "dB", least_gain >= 3.0),
            Requirement("phase margin", least_phase, 40.0, "deg", least_phase >= 40.0, "the limit of this sample"),
        ),
    )  # fmt: skip


def attitude(gain=1.0, lead=1.0):
    return open_loop(0.16 * gain, 5.0 * lead, 0.417, 0.25)


def translation(gain=1.0, lead=1.0):
    return open_loop(1.5625e-4 * gain, 160.0 * lead, 13.3, 8.0)


def guidance_loop(point):
    """Only measured, and judged in part."""
    system = control.tf([0.12, 0.0], [1, -0.9], 4.0)
    curve = measured(curve_of(system), 40)
    found, distances = classical(system), robust(curve)
    found = replace(found, gain=(), encirclements=None)
    why = "the plan is solved anew at every step: a small change may find another solution"
    return LoopReport(
        f"guidance at {point}", "guidance", point, "guidance.acceleration[2]", "plant.acceleration[2]", "m/s2", 4.0,
        (), "as declared", curve, found, distances, None, None,
        route_b=RouteB(1e-3, 40, 2, 4096.0, 0.083, 0.02, curve),
        not_applicable={"route A": "the FMU someone_elses does not give its state", "dispersion": "no campaign"},
        amplitudes=tuple(
            AmplitudePoint(a, curve.value[12] * (1.0 + 0.4 * a), 0.4 * a) for a in (1e-3, 1e-2, 0.1, 0.3, 1.0)
        ),
        amplitude_frequency=float(curve.frequency[12]),
        requirements=(
            Requirement("gain margin", None, 6.0, "dB", None, why),
            Requirement("half-amplitude change", 8.3, 1.0, "%", None, "discontinuous: see the amplitude sweep"),
        ),
    )  # fmt: skip


def sweep():
    """The translation loop over its gain, whose lower limit of the phase margin is crossed."""
    values = np.geomspace(0.2, 8.0, 25)
    found = [classical(translation(value)) for value in values]
    phase = np.array([item.phase_margin.value for item in found])
    gain = np.array([item.gain_margin.value for item in found])
    late = values > values[np.argmax(phase)]
    crossed = float(np.interp(-math.radians(30.0), -phase[late], values[late]))
    return SweepReport(
        "gain of the translation loop", "translation", "translation_control.gain", "1", values, gain, phase,
        {"phase margin 30 deg": crossed},
    )  # fmt: skip


def joint(point):
    """Two channels that do not act on each other: the least of both at every frequency."""
    curves = [curve_of(attitude(gain)) for gain in (1.0, 1.6)]
    margins = np.min([1.0 / np.abs(1.0 / (1.0 + curve.value) - 0.5) for curve in curves], axis=0)
    least = int(np.argmin(margins))
    alpha = float(margins[least])
    return JointReport(
        "attitude", point, ("attitude x", "attitude y"), alpha, (2 + alpha) / (2 - alpha), 2 * math.atan(alpha / 2),
        float(curves[0].frequency[least]), curves[0].frequency, margins,
        (Requirement("disk margin", alpha, 0.4, "1", alpha >= 0.4),),
    )  # fmt: skip


def points():
    trim = (("plant.position[0]", 5312.25, 0.8125, "m"), ("plant.attitude[1]", 0.5, 1e-5, "rad"))
    return (
        PointReport("far", "acceleration", 800.0, {"guidance.frozen": True}, trim, 0.004, 1200.0),
        PointReport("hold", "keeping the final place", 4500.0, {}, (), 0.0, math.inf),
    )


def sample_provenance():
    return {
        "system": "robot_rendezvous",
        "system_sha256": DIGEST,
        "fmus": {
            "plant": {"fmu": "rendezvous_plant", "sha256": DIGEST[::-1], "guid": "x"},
            "attitude_control": {"fmu": "attitude_control", "sha256": DIGEST, "guid": "y"},
        },
        "parameters": {f"plant.inertia[{k}]": 500.0 + k / 3 for k in range(40)},
        "step": 0.125,
        "seed": 7,
        "algorithm": "sequential",
        "faults": [],
        "perilune": "0.1.0",
        "versions": {"python": "3.11.9", "control": control.__version__, "numpy": np.__version__},
    }


def sample_report():
    """All that a page can show; the dispersed phase margin fails."""
    second = linear_loop("translation", translation(), "far", dispersion=dispersion(translation), unit="N")
    return StabilityReport(
        "robot_rendezvous",
        sample_provenance(),
        {"gain_margin_db": 6.0, "phase_margin_deg": 30.0, "modulus_margin": 0.5},
        points(),
        (
            linear_loop("attitude", attitude(), "hold", nonlinearities=(relay(attitude()),)),
            second,
            guidance_loop("far"),
        ),
        (joint("hold"),),
        (sweep(),),
        (),
        12.5,
    )


def replace_loops(report, loops):
    return StabilityReport(
        report.system, report.provenance, report.limits, report.points, tuple(loops), (), (), (), report.seconds
    )
