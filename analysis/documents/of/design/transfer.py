"""Document of a transfer between two hovers: plans, their times, and the optimality conditions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import partial

from ....design.transfers.adjoint import AdjointSolution
from ....design.transfers.hover_study import HoverStudy
from ...cell import Cell, Head, Inline, LegendEntry, Phrase, Quantity
from ...model import Document, KeyNumbers, Node, Note, Section, Table, Text
from ...pictures import Figures
from .plan_figures import NAMES, Series, curve_figures, path_figure, plan_series, time_figures
from .programme_sketch import sketch_figure
from .transfer_json import transfer_json

TIMES = ("t2", "t3", "t4", "t5", "w", "k", "tp", "t7")  # k has no unit, the others are in s
PITCH = "Pitch from the horizontal, deg"
Times = dict[str, float | None]


def transfer_document(study: HoverStudy) -> Document:
    """Return the document of a study; curves are computed when they are drawn."""
    series = plan_series(study)
    legend = [LegendEntry(one.look, [one.name]) for one in series]
    path = Note(
        "The start is at 0, 0; dot: end. Arrows: thrust of the simplified programme at equally spaced times, "
        "longer at full throttle."
    )
    others = Note(
        "Line: simplified programmes of this vehicle, with gaps where none exists. Marks: the plans above, in "
        "their colours."
    )
    sections = [
        Section("Plans", [_plans(study, series), _limits(study)]),
        Section(
            "Times",
            [_times(study), *_remarks(study), Figures(partial(sketch_figure, study.programme)), _sketched(study)],
        ),
        *([Section("Conditions of the optimum", _conditions(study.adjoint))] if study.adjoint else []),
        *([Section("Turning in free fall", [_comparisons(study)])] if study.comparisons else []),
        Section("Path", [Figures(partial(path_figure, series), legend), path]),
        Section("Over time", [Figures(partial(time_figures, series, PITCH), legend)]),
        Section("Other times and places", [Figures(partial(curve_figures, study, series)), others]),
    ]
    return Document("Hover transfer", _summary(study), sections, transfer_json(study))


def burns_phrase(burns: Iterable[tuple[float, float]]) -> list[Inline]:
    """Return begin and end (s) of each burn to a tenth, without the unit."""
    content: list[Inline] = []
    for begin, end in burns:
        content += [*([", "] if content else []), _tenths(begin), " to ", _tenths(end)]
    return content


def _tenths(time: float) -> Quantity:
    """Return a time (s) rounded to a tenth, the resolution of a grid."""
    return Quantity(time, digits=len(f"{time:.1f}") - 1)


def _summary(study: HoverStudy) -> list[Node]:
    transfer, programme, vehicle = study.transfer, study.programme, study.vehicle
    planned, engine = programme.vehicle, vehicle.maximum_thrust
    fraction = programme.propellant_fraction
    dry: list[Inline] = [", dry ", Quantity(vehicle.dry_mass, "kg", 6)] if vehicle.dry_mass else []
    numbers: list[tuple[str, Cell]] = [
        ("propellant", Quantity(fraction * vehicle.mass, "kg", 5)),
        ("propellant fraction", Quantity(fraction, digits=5)),
        ("duration", Phrase([Quantity(programme.duration, "s", 5), " (given)" if study.is_duration_set else ""])),
        ("relative to vertical descent", Quantity(fraction / study.vertical.propellant_fraction, digits=5)),
        ("programme", programme.kind),
    ]
    limits: list[Inline] = [
        "Mass ", Quantity(vehicle.mass, "kg", 6), *dry, "; specific impulse ", Quantity(vehicle.specific_impulse, "s"),
        "; thrust ", Quantity(vehicle.minimum_thrust, digits=6), " to ", Quantity(engine, "N", 6), "; gravity ",
        Quantity(transfer.gravity, "m/s2"), "; the plan's throttle ", Quantity(planned.minimum_thrust / engine), " to ",
        Quantity(planned.maximum_thrust / engine), "; its angular acceleration ",
        Quantity(planned.angular_acceleration, "rad/s2"), ".",
    ]  # fmt: skip
    way: list[Inline] = [
        "from rest, vertical, to rest, vertical: ", Quantity(transfer.distance, "m"), " downrange, ",
        Quantity(transfer.descent, "m"), " descent",
    ]  # fmt: skip
    return [Text(way), KeyNumbers(numbers), Note(limits)]


def _plans(study: HoverStudy, series: Sequence[Series]) -> Table:
    """Return propellant, duration and burns of each plan, and the grid of plans on a grid."""
    gridded = [study.optimum, study.bound]
    others = (("finite switches", study.finite), ("turn in free fall", study.free_fall))
    rows: list[tuple[Cell, float, float, int | None, Iterable[tuple[float, float]]]] = [
        (
            LegendEntry(one.look, [one.name]),
            one.path.propellant_fraction,
            one.path.duration,
            one.path.throttle.size if any(one.path is each for each in gridded) else None,
            one.path.burns(),
        )
        for one in series
    ]
    rows += [(name, plan.propellant_fraction, plan.duration, None, plan.full_thrust) for name, plan in others if plan]
    vertical = study.vertical
    rows.append(("vertical descent", vertical.propellant_fraction, vertical.duration, None, vertical.burns))
    has_grid = any(each is not None for each in gridded)
    lines: list[list[Cell]] = [
        [
            name,
            Quantity(fraction, digits=5),
            Quantity(fraction * study.vehicle.mass, digits=5),
            Quantity(duration),
            *([intervals] if has_grid else []),
            Phrase(burns_phrase(burns)),
        ]
        for name, fraction, duration, intervals, burns in rows
    ]
    grid = ["intervals"] if has_grid else []
    return Table(
        [Head("plan", column="names"), "propellant fraction", "kg", "duration, s", *grid, "full thrust, s"], lines
    )


def _limits(study: HoverStudy) -> Note:
    """Return a note on the limits of the plans, and on plans that are not computed."""
    plans = zip(NAMES[1:], (study.optimum, study.bound), strict=True)
    missing = ", ".join(name for name, plan in plans if plan is None)
    margins = ", the control margins" if study.margins else ""
    return Note(
        f"The programme and the true optimum observe the plan's limits of throttle and angular "
        f"acceleration{margins}; the bound may use the engine's full thrust in any direction."
        + (f" Not computed: {missing}." if missing else "")
    )


def _times(study: HoverStudy) -> Table:
    """Return the times of the plans that have them, without empty columns."""
    t2, t5, w, tp, t7 = study.programme.times
    rows: dict[str, Times] = {
        NAMES[0]: {"t2": t2, "t5": t5, "w": w, "k": study.programme.threshold, "tp": tp, "t7": t7}
    }
    if study.finite is not None:
        rows["finite switches"] = dict(zip(("t2", "t3", "t4", "t5", "t7"), study.finite.times, strict=True))
    if study.free_fall is not None:
        elements = study.free_fall.times.elements()
        rows["turn in free fall"] = dict(zip(("t2", "t5", "w", "tp", "t7"), elements, strict=True))
    names = [name for name in TIMES if any(times.get(name) is not None for times in rows.values())]
    heads = [name if name == "k" else f"{name}, s" for name in names]
    lines: list[list[Cell]] = [
        [plan, *(Quantity(times.get(name), digits=5 if plan == NAMES[0] and name[0] == "t" else 4) for name in names)]
        for plan, times in rows.items()
    ]
    return Table(["plan", *heads], lines)


def _remarks(study: HoverStudy) -> list[Text]:
    """Return remarks on the attitude of the programme, the cost of finite switches, and the turn in free fall."""
    low, high = study.programme.extremes
    remarks: list[list[Inline]] = [
        [
            "pitch of the programme ", Quantity(low, "rad", 3, is_bare=True), " to ", Quantity(high, "rad"),
            ", largest rate ", Quantity(study.programme.turn_rate, "rad/s"),
        ]
    ]  # fmt: skip
    if study.finite is not None and study.optimum is not None:
        fraction = study.optimum.propellant_fraction
        more = study.finite.propellant_fraction - fraction
        remarks.append(
            [
                "finite switches take ", Quantity(more * study.vehicle.mass, "kg", 3), " more than the true optimum (",
                Quantity(100.0 * more / fraction, digits=3), " %)",
            ]
        )  # fmt: skip
    plan = study.free_fall
    if plan is not None:
        remarks.append(
            [
                "turn in free fall: engine off for ", Quantity(plan.fall, "s"), ", then ",
                Quantity(plan.last_burn, "s"), " of full thrust; ", Quantity(plan.drop, "m"), " lower",
            ]
        )  # fmt: skip
    return [Text(each) for each in remarks]


def _sketched(study: HoverStudy) -> Note:
    """Return a note that explains the sketch of the programme."""
    programme = study.programme
    level = (
        " Dashed: k of the largest tilt, at which the initial burn begins and ends unless it reaches beyond the first "
        "or the second reversal."
    )
    return Note(
        "Shaded: full thrust. Tilt is negative towards the target, largest at t2; the initial burn is centred there, "
        "its half width is w. At t5 the tilt is largest the other way, at t7 thrust is upright; the last burn begins "
        "tp before." + (level if programme.threshold is not None and programme.programme.width else "")
    )


def _conditions(adjoint: AdjointSolution) -> list[Text]:
    """Return initial costates, and the residuals of the optimality conditions."""
    begin, end = adjoint.singular_span
    rms, largest = adjoint.tangent_residual
    first, last = adjoint.reversals
    psi = adjoint.costates[0, 0].tolist()
    zeros = [each for time in adjoint.switching_times for each in (", ", _tenths(time))][1:]
    names = zip(("psi1 ", ", psi2 ", ", psi3 ", ", psi4 "), psi, ("/m", " s/m", "/m", " s/m"), strict=False)
    costates = [each for name, costate, unit in names for each in (name, Quantity(costate), unit)]
    arc: list[Inline] = [
        _tenths(begin), " to ", _tenths(end), " s: pitch within ", Quantity(largest, "rad", 2), ", ",
        Quantity(rms, "rad", 1), " rms",
    ]  # fmt: skip
    sentences: list[list[Inline]] = [
        ["costates at the start: ", *costates],
        ["multipliers before the end: within ", _decade(adjoint.mismatch)],
        ["tangent law, ", *(["no arc"] if math.isnan(begin) else arc)],
        [f"angular acceleration: {first} reversals before, {last} after"],
        ["psi7 of the wrong sign: below ", _decade(adjoint.turning_residual), " of its largest"],
        ["switching function: zero at ", *zeros, " s"],
        ["switching function of the wrong sign: below ", _decade(adjoint.switching_residual), " of its largest"],
        ["Hamiltonian: within ", _decade(adjoint.hamiltonian_residual), " of the largest switching function"],
    ]
    return [Text(each) for each in sentences]


def _decade(residual: float) -> Quantity:
    """Return the next power of ten, because residuals below a solver's precision differ between machines."""
    return Quantity(10.0 ** math.ceil(math.log10(residual)) if residual > 0.0 else 0.0, digits=1)


def _comparisons(study: HoverStudy) -> Table:
    """Return the table of programme and turn in free fall over distance, empty without this kind of programme."""
    mass = study.vehicle.mass
    rows: list[list[Cell]] = []
    for each in study.comparisons:
        more = each.free_fall - each.programme
        kilograms = [(mass * each.programme, 5), (mass * each.free_fall, 5), (mass * more, 4)]
        numbers = [(each.distance, 4), *kilograms, (100.0 * more / each.programme, 3)]
        rows.append([Quantity(None if math.isnan(number) else number, digits=digits) for number, digits in numbers])
    return Table(["distance, m", "programme, kg", "turn in free fall, kg", "more, kg", "more, %"], rows)
