"""Document of a worst case: value and conditions, search, random trials, box, simulation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import chdir
from dataclasses import replace
from functools import partial
from pathlib import Path

from ....campaigns.definition.campaign import TrialRecord
from ....campaigns.definition.plan import BatchPlan
from ....campaigns.draws.interfaces import input_names
from ....campaigns.draws.supplied import SuppliedDraws, part_streams, stream_component
from ....campaigns.execute.flyer import Flyer
from ....runtime.flight.results import FlightResult
from ....studies.worst.outcome import WorstOutcome
from ...cell import Cell, Code, Quantity, Rich
from ...common.quantities import label_with_unit
from ...figures.declared import FigureDeclaration
from ...figures.figure_reader import read_figures
from ...model import Document, Medium, Node, Note, Only, Section, Table, Text, Verdict
from ...pictures import Figures
from ..simulation.nodes import simulation_nodes
from .conditions import closing_sections, condition_nodes, condition_of
from .worst_figures import box_figures, random_figures, search_figures
from .worst_points import box_lanes, objective_of

DIGITS = 6
DECIMALS = 3  # decimals of fractions of the search box

Simulate = Callable[[], tuple[FlightResult, Sequence[FigureDeclaration]]]


def worst_document(study: WorstOutcome, folder: Path | None = None, simulate: Simulate | None = None) -> Document:
    """Return the document of a worst case; ``folder`` is the folder that stores it, if any.

    ``simulate`` returns the worst case with all signals and the figures that the system declares; None for a margin.
    """
    condition = condition_of(study)
    replay = study.replay(folder, 0)
    sections = [
        Section(
            "Search",
            [
                Figures(partial(search_figures, study)),
                Only(Medium.PAGE, lambda: [_phases(study)]),
                Note(
                    "Grey: every point; blue: the worst so far; numbers: methods in their order. "
                    f"The best of the random trials begin the evolution.{_of_realisations(study)}"
                ),
            ],
            condition,
        ),
        Section(
            "Against random trials",
            [
                Figures(partial(random_figures, study)),
                Note(
                    "Random trials are drawn as the campaign draws them, also outside of the box; they are the first "
                    "points of the search."
                ),
                metric_table(study),
            ],
            condition,
        ),
        Section("Search box", _box_nodes(study), condition),
        *(
            [
                Section(
                    "Simulation of the worst case",
                    [Only(Medium.PAGE, partial(_simulation, study, simulate))],
                    condition,
                )
            ]
            if simulate
            else []
        ),
        *closing_sections(study, [("worst case", replay)] if replay else []),
    ]
    title = f"{study.facts['system']}: worst case"
    return Document(title, [_verdict(study)], sections, study.json_document(folder))


def _verdict(study: WorstOutcome) -> Verdict:
    realisations, largest, random = study.over, study.worst_realisation, study.worst_random
    objective = objective_of(study)
    outside = "" if random["inside"] else ", outside of the box"
    name: Rich = [study.badness.text if study.badness.expression is None else Code(study.badness.text)]
    flown: Rich = []
    if realisations is not None:
        extreme = [] if largest is None else ["; worst of them ", _objective_cell(study, study.as_json(largest))]
        flown = [f" ({study.flown_text}", *extreme, ")"]
    simulations = "simulations" if objective.rising else "studies"
    return Verdict(
        [
            *name, ": worst " if objective.rising else ": least ", _objective_cell(study, study.worst["value"]), *flown,
            f", of {objective.values.size} points in {study.flights} {simulations}{study.conditions}",
        ],
        [
            *_noise_effect(study),
            *([Text(f"failed: {study.reason}")] if study.reason else []),
            Text([
                f"worst of {study.random_trials} random trials: ", _objective_cell(study, random["value"]),
                f"{f' ({realisations.text})' if realisations else ''}{outside}{study.conditions}",
            ]),
            Text([
                "search box: within ", Quantity(study.sigmas), " standard deviations of normal parameters, the full "
                "range of others; a search proves no bound: there may be a worse point",
            ]),
            *condition_nodes(study, "random" if realisations is None else _noise(study)),
        ],
    )  # fmt: skip


def _objective_cell(study: WorstOutcome, size: float | str | None, *, is_bare: bool = False) -> Quantity | str:
    """Return a value of the objective as a cell; without a value, the statement that the simulation failed."""
    return _cell(size, study.unit, is_bare=is_bare)


def _cell(size: float | str | None, unit: str | None, *, is_bare: bool = True) -> Quantity | str:
    if isinstance(size, str) or size is None:
        return size or "failed"
    return Quantity(float(size), unit, DIGITS, is_bare)


def _noise_effect(study: WorstOutcome) -> list[Node]:
    """Return the effect of new noise on the worst case; no statement if noise is not random."""
    if study.fresh is None or study.over is None:
        return []
    fresh = study.fresh.document(study.as_json)
    quantile = (
        [f", {study.over.name} ", _objective_cell(study, fresh["at_quantile"])] if fresh["quantile"] < 1.0 else []
    )
    return [
        Text([
            f"the same point under {fresh['realisations']} fresh noise realisations: worst ",
            _objective_cell(study, fresh["worst"]), *quantile, study.conditions,
        ]),
        Note("The search has not used these; its own number is biased towards worse, since it chose the point."),
    ]  # fmt: skip


def _noise(study: WorstOutcome) -> str:
    """Return how the search treated random noise."""
    assert study.over is not None
    count = study.over.count
    if study.noise_matters is False:
        return f"changes none of the random trials in {count} realisations, so the search uses one"
    return f"the same {'realisation' if count == 1 else f'{count} realisations'} at every point"


def _of_realisations(study: WorstOutcome) -> str:
    realisations = study.over
    if realisations is None or realisations.count == 1:
        return ""
    only = " of random trials" if study.noise_matters is False else ""
    return f" The number of a point{only} is the {realisations.text}, not that of a single simulation."


def _phases(study: WorstOutcome) -> Table:
    """Return a row for each phase of the search, with the worst value by its end, as displayed."""
    worst = objective_of(study).worst_so_far()
    rows: list[tuple[Cell, ...]] = []
    end = 0
    for index, phase in enumerate(study.phases):
        end += phase.evaluations
        size = float(worst[end - 1])
        rows.append((index + 1, phase.name, phase.evaluations, Quantity(None if size != size else size, digits=DIGITS)))
    return Table(("", "method", "points", label_with_unit("worst so far", study.unit)), rows)


def metric_table(study: WorstOutcome) -> Table:
    """Return a row for each metric: in the worst case and in the worst random trial."""
    worst, random, units = study.worst["metrics"], study.worst_random["metrics"], study.units
    rows = [
        (label_with_unit(name, units.get(name)), *(_cell(each[name], units.get(name)) for each in (worst, random)))
        for name in worst
    ]
    return Table(("metric", "worst case", "worst random trial"), rows, len(rows))


def parameter_table(study: WorstOutcome) -> Table:
    """Return a row for each dispersed parameter: worst case, box, worst random trial."""
    rows = [
        (
            lane.label,
            *(_cell(each, lane.unit) for each in (lane.worst, lane.low, lane.high)),
            Quantity(lane.at(lane.worst), decimals=DECIMALS),
            _cell(lane.random, lane.unit),
        )
        for lane in box_lanes(study)
    ]
    heads = ("parameter", "worst case", "box from", "to", "fraction of the box", "worst random trial")
    return Table(heads, rows, len(rows))


def _box_nodes(study: WorstOutcome) -> list[Node]:
    return [
        Only(Medium.PAGE, lambda: [Figures(partial(box_figures, study))]),
        parameter_table(study),
        Note(
            "The box spans uniform parameters between their ends and normal ones within these standard deviations; "
            "jointly normal ones along the axes of their covariance, so that they reach their ends one at a time. A "
            "parameter at an end of the box says that the worst case may lie beyond it."
        ),
    ]


def _simulation(study: WorstOutcome, simulate: Simulate) -> list[Node]:
    simulation, figures = simulate()
    realisations = study.over
    end: Rich = [" at ", Quantity(float(simulation.time[-1]), "s", DIGITS)] if simulation.time.size else []
    chosen = ""
    if realisations is not None and realisations.count > 1 and study.noise_matters is not False:
        chosen = f"; of the noise realisations it has the one that gives the {realisations.name}"
    return [Text(["status ", Code(simulation.status), *end, chosen]), *simulation_nodes(simulation, figures)]


def simulate_worst(study: WorstOutcome, plan: BatchPlan) -> tuple[FlightResult, list[FigureDeclaration]]:
    """Simulate the worst case of a study's ``plan``, equal to the search to the last bit. Raises InputError."""
    plotted = study.flown.draws
    names = [*input_names(plan.campaign), *(name for name in plotted if stream_component(name) is not None)]
    supplied = SuppliedDraws(*part_streams({name: plotted[name][[study.row]] for name in names}))
    plain = replace(plan, campaign=replace(plan.campaign, record=TrialRecord(), group=None, scatters=()))
    with chdir(Path.cwd()):  # an FMU may change the folder
        flyer = Flyer(plain.of_samples(supplied))
        (variant,) = flyer.variants
        simulation, _ = flyer.replay(variant, 0)
        return simulation, read_figures(plain.prepare(flyer.variants[variant]))
