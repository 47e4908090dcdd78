"""Parts of one loop's article: a heading, a table and a note each."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ....stability.loops.margin_values import MARGINS
from ....stability.results.report import LoopReport
from ....stability.results.responses import Mode, Nonlinearity
from ....stability.results.varied import LEVELS, Dispersion
from ...cell import Cell, Head, Rich
from ...common.quantities import MINUS, NONE, display_unit, label_with_unit
from ...model import Table
from ...pictures import Figure
from .study_cells import (
    NO_CROSSING,
    UNSTABLE_WORD,
    complex_number,
    gain_margin,
    in_decibels,
    in_degrees,
    mode_numbers,
    numbers,
    numeral,
    per_cent,
    phase_margin,
    samples,
    sentences,
    size,
    state,
    text_of_closed_loop,
)


@dataclass(frozen=True)
class Part:
    """A heading with a table of ``rows``, followed by a note, a ``command`` and figures."""

    key: str
    heading: str
    table: Table
    note: Rich = ""
    command: str = ""
    rows: str = "rows"
    figures: list[Figure] = field(default_factory=list)


def method(loop: LoopReport) -> Part:
    """Return linearised and measured response side by side, and their agreement."""
    rows: list[tuple[Cell, ...]] = []
    if loop.linearised is not None:
        a = loop.linearised
        rows += [
            ("A, linearisation", "states", numeral(a.states)),
            ("", "period, s", numeral(a.period)),
            ("", "finite-difference step sensitivity, %", per_cent(a.plateau)),
            ("", "states with non-smooth dynamics", ", ".join(a.doubtful) or "none"),
            ("", "response at other frequencies, %", per_cent(a.periodicity)),
        ]
    if loop.measured_response is not None:
        b = loop.measured_response
        rows += [
            (
                "B, frequency-response test",
                f"amplitude of a line, {display_unit(loop.unit) or '1'}",
                numeral(b.amplitude, loop.unit),
            ),
            ("", "lines", numeral(b.lines)),
            ("", "periods", f"{b.periods}"),
            ("", "period, s", numeral(b.period)),
            ("", "change at half the amplitude, %", per_cent(b.half_amplitude_change)),
            ("", "response on other lines, %", per_cent(b.unexcited)),
        ]
    if loop.agreement is not None:
        compared = loop.agreement
        rows += [
            ("A compared with B", "largest difference of gain, dB", in_decibels(compared.gain, absolute=True)),
            ("", "largest difference of phase, deg", in_degrees(compared.phase)),
            ("", "compared up to, rad/s", numeral(compared.frequency)),
            ("", "responses agree", "yes" if compared.agrees else "no"),
        ]
    return Part("method", "Method", Table(["method", "quantity", *numbers("value")], rows))


def classical(loop: LoopReport) -> Part:
    """Return all crossings, the delay margin, and the number of encirclements."""
    margins = loop.classical
    rows: list[tuple[Cell, ...]] = []
    kind = "crossing" if loop.margins.unstable else "margin"
    for crossing in margins.gain:
        name = f"{'upper' if crossing.value >= 1.0 else 'lower'} gain {kind}"
        rows.append((name, in_decibels(crossing.value, absolute=True), "dB", numeral(crossing.frequency)))
    if not margins.gain:
        rows.append((f"gain {kind}", NO_CROSSING, "", ""))
    for crossing in margins.phase:
        name = f"phase {kind}" if crossing.value >= 0.0 else f"phase {kind}, lead"
        rows.append((name, in_degrees(crossing.value), "deg", numeral(crossing.frequency)))
    if not margins.phase:
        rows.append((f"phase {kind}", NO_CROSSING, "", ""))
    if loop.margins.unstable:
        rows.append(("delay margin", UNSTABLE_WORD, "", ""))
    elif math.isfinite(margins.delay_margin):
        rows.append(("delay margin", numeral(margins.delay_margin), "s", numeral(margins.delay_frequency)))
        rows.append(("", samples(margins.delay_margin, loop.sample_period), "samples", ""))
    else:
        rows.append(("delay margin", NO_CROSSING, "", ""))
    encircled = numeral(margins.encirclements) if margins.encirclements is not None else "not counted"
    rows.append((f"counter-clockwise encirclements of {MINUS}1", encircled, "", ""))
    unstable = numeral(loop.unstable_open) if loop.unstable_open is not None else "not known"
    rows.append(("unstable poles of the open loop", unstable, "", ""))
    rows.append(("closed loop", text_of_closed_loop(loop.stable), "", ""))
    note = "The closed loop is unstable: its crossings are not margins." if loop.margins.unstable else ""
    return Part(
        "classical", "Classical", Table(["quantity", *numbers("value"), "unit", *numbers("at rad/s")], rows), note
    )


def robust(loop: LoopReport) -> Part:
    """Return the distances from the critical point: modulus margin, sensitivity peaks, disk margin."""
    margins = loop.robust
    token = state(loop.margins)
    rows: list[tuple[Cell, ...]] = [
        ("modulus margin", token or numeral(margins.modulus_margin), numeral(margins.sensitivity_frequency)),
        ("peak of S, dB", in_decibels(margins.sensitivity_peak), numeral(margins.sensitivity_frequency)),
        ("peak of T, dB", in_decibels(margins.complementary_peak), numeral(margins.complementary_frequency)),
        ("disk margin", token or numeral(margins.disk_margin), numeral(margins.disk_frequency)),
        ("— gain, upper and lower, dB", token or in_decibels(margins.disk_gain, "without limit"), ""),
        ("— phase, deg", token or in_degrees(margins.disk_phase), ""),
    ]
    note = "The closed loop is unstable: the peaks of the response are not bounds." if loop.margins.unstable else ""
    return Part("robust", "Robust", Table(["quantity", *numbers("value", "at rad/s")], rows), note)


def drop_conjugates(modes: tuple[Mode, ...]) -> list[Mode]:
    """Return modes without the lower pole of conjugate pairs."""
    return [
        mode
        for mode in modes
        if mode.z.imag >= 0.0 or not any(np.isclose(other.z, np.conj(mode.z)) for other in modes if other is not mode)
    ]


def modes(loop: LoopReport) -> Part:
    """Return closed-loop modes, one per conjugate pair."""
    rows: list[tuple[Cell, ...]] = [
        (
            complex_number(mode.z),
            numeral(abs(mode.z)),
            *mode_numbers(mode.z, mode.s, mode.damping, mode.frequency),
            mode.kind,
            numeral(mode.controllability, digits=2),
            numeral(mode.observability, digits=2),
        )
        for mode in drop_conjugates(loop.modes)
    ]
    sizes, shares = ("z", "|z|", "s, rad/s", "damping", "frequency, rad/s"), ("controllability", "observability")
    note = "A conjugate pair is one row, with ±."
    if any(mode.z.imag == 0.0 and mode.z.real < 0.0 for mode in loop.modes):
        note += (
            " A real z below 0 is a single pole, not a pair: its response changes sign with every sample and is "
            f"multiplied by |z|, so s = ln(z)/T, damping and frequency are left out ({NONE})."
        )
    return Part("modes", "Modes", Table([*numbers(*sizes), "kind", *numbers(*shares)], rows), note, rows="modes")


def structure(loop: LoopReport) -> Part:
    """Return controllability and observability."""
    margins = loop.structure
    assert margins is not None
    rows: list[tuple[Cell, ...]] = [
        ("states of the whole system", numeral(margins.states), ""),
        ("controllable from the break point", numeral(margins.controllable), numeral(margins.least_controllable)),
        ("observable at the break point", numeral(margins.observable), numeral(margins.least_observable)),
        ("both: order of the loop", numeral(margins.order), ""),
    ]
    return Part("structure", "Structure", Table(["part", *numbers("rank", "smallest retained singular value")], rows))


def dispersion_rows(dispersion: Dispersion) -> Part:
    """Return least, 5 % and median margins over the campaign, and the command that studies the worst trial."""
    rows: list[tuple[Cell, ...]] = []
    for quantity in MARGINS:
        unit = "" if quantity.unit == "1" else f", {quantity.unit}"
        cells = [size(value) for value in dispersion.levels(quantity).values()]
        rows.append((f"{quantity}{unit}", *cells, size(dispersion.margins[dispersion.worst].size(quantity))))
    heads: list[str | Head] = ["margin", *numbers(*LEVELS, f"trial {dispersion.worst}, the worst")]
    counted = f"{dispersion.unstable} of {dispersion.trials} trials are unstable"
    unstable = counted if dispersion.unstable else "all trials are stable"
    radius = ", or among unstable trials the largest spectral radius" if dispersion.unstable else ""
    note = (
        f"Campaign {dispersion.campaign}: {unstable}. Levels are order statistics of the margins of all trials; "
        "an unstable trial counts as below every number, and a trial without a crossing as above. The worst "
        "trial has the least disk "
        f"margin{radius}."
    )
    return Part("dispersed", "Dispersed", Table(heads, rows), note, dispersion.replay)


def nonlinear(nonlinearity: Nonlinearity, index: int) -> Part:
    """Return the limit cycles predicted by harmonic balance, and the limit cycles found by simulation."""
    rows: list[tuple[Cell, ...]] = []
    for cycle in nonlinearity.cycles:
        lasting = cycle.simulated_amplitude is not None
        rows.append(
            (
                numeral(cycle.amplitude, nonlinearity.unit),
                numeral(cycle.period),
                "stable" if cycle.stable else "unstable",
                numeral(cycle.simulated_amplitude, nonlinearity.unit) if lasting else "no lasting oscillation",
                numeral(cycle.simulated_period),
            )
        )
    if not rows:
        rows.append((NO_CYCLE, "", "", "", ""))
    amplitude, simulated = (label_with_unit(name, nonlinearity.unit) for name in ("amplitude", "simulated amplitude"))
    heads: list[str | Head] = [
        *numbers(amplitude, "period, s"),
        "predicted to be",
        *numbers(simulated, "simulated period, s"),
    ]
    values = ", ".join(f"{name} {value:.6g}" for name, value in nonlinearity.parameters.items())
    kind = f"{nonlinearity.kind}{': ' + values if values else ''}"
    about = f"{kind}. Amplitudes at the element's input. {nonlinearity.note}"
    return Part(f"nonlinear-{index}", f"Nonlinear: {nonlinearity.name}", Table(heads, rows), about.strip())


NO_CYCLE = "no limit cycle predicted"


def amplitudes(loop: LoopReport) -> Part:
    """Return gain and phase at one frequency over the amplitude of the injected signal."""
    rows: list[tuple[Cell, ...]] = [
        (
            numeral(point.amplitude, loop.unit),
            in_decibels(abs(point.value)),
            in_degrees(float(np.angle(point.value))),
            per_cent(point.change),
        )
        for point in loop.amplitudes
    ]
    heads = numbers(label_with_unit("amplitude", loop.unit), "gain, dB", "phase, deg", "change, %")
    at = ["At ", numeral(loop.amplitude_frequency), " rad/s; changes are relative to the smallest amplitude's."]
    return Part("amplitudes", "Amplitude dependence", Table(heads, rows), at, rows="amplitudes")


def sampling(loop: LoopReport) -> Part:
    """Return margins with other communication steps."""
    rows: list[tuple[Cell, ...]] = [
        (
            numeral(item.step),
            gain_margin(item.margins) if item.margins else numeral(None),
            phase_margin(item.margins) if item.margins else numeral(None),
            item.note,
        )
        for item in loop.sampling
    ]
    heads: list[str | Head] = [*numbers("step, s", "gain margin, dB", "phase margin, deg"), *sentences("note")]
    return Part("sampling", "Sampling", Table(heads, rows))


def parts(loop: LoopReport) -> list[Part]:
    """Return all available parts of a loop, in the order of the page."""
    sections = [method(loop), classical(loop), robust(loop)]
    if loop.structure is not None:
        sections.append(structure(loop))
    if loop.modes:
        sections.append(modes(loop))
    if loop.dispersion is not None:
        sections.append(dispersion_rows(loop.dispersion))
    if loop.amplitudes:
        sections.append(amplitudes(loop))
    sections += [nonlinear(item, index) for index, item in enumerate(loop.nonlinearities)]
    if loop.sampling:
        sections.append(sampling(loop))
    return [part for part in sections if part.table.rows]


def list_absent(loop: LoopReport) -> list[str]:
    """Return the analyses that a loop's study does not include, except failed ones, which have a reason."""
    there = {
        "linearisation": loop.linearised is not None,
        "frequency-response test": loop.measured_response is not None,
        "modes": bool(loop.modes) or loop.linearised is None,
        "structure": loop.structure is not None or loop.linearised is None,
        "step response": loop.step is not None,
        "dispersion": loop.dispersion is not None,
        "amplitude sweep": bool(loop.amplitudes),
        "nonlinear elements": bool(loop.nonlinearities),
        "sampling": bool(loop.sampling),
    }
    return [name for name, is_there in there.items() if not is_there and name not in loop.not_applicable]
