"""Document of a rare failure: probability, interval and their conditions, levels, design points, replays."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from ....studies.rare.interpretation import equivalents, influence, level_spans
from ....studies.rare.outcome import RareOutcome
from ...cell import Cell, Code, Quantity, Rich
from ...common.quantities import label_with_unit
from ...model import Document, KeyNumbers, Medium, Node, Note, Only, Section, Table, Text, Verdict
from ...pictures import Figures
from .conditions import UNWRITTEN, closing_sections, condition_nodes, condition_of
from .rare_figures import DESIGN_LEGEND, PERCENT, design_figures, exceedance_figures, interval_figures, limit_figures

DECIMALS = 3  # decimals of acceptance rates


def rare_document(study: RareOutcome, folder: Path | None = None) -> Document:
    """Return the document of a rare failure; ``folder`` is the folder that stores it, if any."""
    condition = condition_of(study)
    verdict = Verdict(
        [*_estimate(study), study.conditions],
        [
            Text(["failure: ", Code(study.failure.text)]),
            *([Text(_bound(study))] if study.why_levels_ended else []),
            *condition_nodes(study),
        ],
        is_bad=study.probability is None,
    )
    sections = [
        Section("Interval against Monte Carlo", [Only(Medium.PAGE, partial(_against_monte_carlo, study))], condition),
        Section(
            "Limit state over simulations",
            [
                Figures(partial(limit_figures, study)),
                Note(
                    "The limit state is 0 or more where the failure occurs. Blue: the threshold of the next level, "
                    "which the worst samples of this one exceed; numbers: levels. Dashed: the failure. From level 2 "
                    "on, chains propose candidates, and those below the level's own threshold are rejected; they are "
                    "also plotted."
                ),
            ],
            condition,
        ),
        Section(
            "Levels",
            [
                level_table(study),
                Figures(partial(exceedance_figures, study)),
                Note(
                    "Probability: conditional probability of the next level given this level, or of the failure "
                    "in the last row. Accepted: fraction of candidates that stay in the level, for moves of "
                    "the dispersed parameters and for moves of the noise, each of which renews the noise "
                    "of one component; for noise, the lowest fraction of any component. Levels end "
                    "when a component accepts fewer than one noise move in twenty. The correlation "
                    "gamma of samples in a chain and the coefficient of variation c.o.v. are those of Au and Beck "
                    "(2001), level by level; the interval above counts the correlation from level to level, too."
                ),
            ],
            condition,
        ),
        Section("Design points", _design_nodes(study), condition),
        *closing_sections(study, _replays(study, folder), UNWRITTEN if study.failures else "no simulation failed"),
    ]
    title = f"{study.facts['system']}: rare failure"
    return Document(title, [verdict, _key_numbers(study)], sections, study.json_document(folder))


def _estimate(study: RareOutcome) -> Rich:
    """Return the probability with its interval, or its bound, with no more digits than the interval justifies."""
    low, high = (Quantity(end, digits=max(study.digits, 2)) for end in study.interval)
    estimate = Quantity(study.probability, digits=study.digits)
    if study.probability is None:
        return ["failure not reached: probability below ", high, f", with {PERCENT} confidence"]
    if study.simulation.noise_ends:
        return ["failure probability below ", high, f", a {PERCENT} bound; estimate ", estimate]
    return ["failure probability ", estimate, f", {PERCENT} interval ", low, " to ", high]


def _bound(study: RareOutcome) -> Rich:
    """Return why levels ended, and how many Monte Carlo simulations would bound smaller probabilities."""
    trials = study.brute_force
    if trials is None:
        return f"{study.why_levels_ended}; probabilities below that level are bounded as in a Monte Carlo analysis"
    return [
        f"{study.why_levels_ended}; probabilities below that level are bounded as by ", Quantity(trials, digits=2),
        " Monte Carlo simulations; a bound ten times lower takes ", Quantity(10.0 * trials, digits=2),
    ]  # fmt: skip


def _key_numbers(study: RareOutcome) -> KeyNumbers:
    simulation = study.simulation
    return KeyNumbers(
        [
            ("simulations", study.flights),
            ("levels", len(simulation.levels)),
            ("samples per level", study.samples),
            ("coefficient of variation", Quantity(simulation.interval.variation, digits=3)),
            ("equivalent Monte Carlo trials", Quantity(study.brute_force, digits=3)),
            ("independent families", simulation.families),
        ]
    )


def _against_monte_carlo(study: RareOutcome) -> list[Node]:
    rows = [
        (row.label, Quantity(row.simulations), Quantity(row.low, digits=3), Quantity(row.high, digits=3))
        for row in equivalents(study)
    ]
    return [
        Figures(partial(interval_figures, study)),
        Table(("estimate", "simulations", "from", "to"), rows),
        Note(
            "Monte Carlo: Clopper and Pearson's interval for the number of failures expected at this probability, "
            "with as many simulations as this study took and with as many as give the same coefficient of variation. "
            "An arrow: from 0."
        ),
    ]


def level_table(study: RareOutcome) -> Table:
    """Return a row for each level of the subset simulation."""
    rows: list[tuple[Cell, ...]] = []
    for span, level in zip(level_spans(study), study.simulation.levels, strict=True):
        reached = None if span.reached is None or level.probability is None else span.reached * level.probability
        rates = (level.draw_acceptance, level.noise_acceptance, level.least_acceptance)
        rows.append(
            (
                span.number,
                Quantity(span.threshold, study.margin_unit, is_bare=True),
                level.samples,
                span.last - span.first + 1,
                Quantity(level.probability),
                Quantity(reached, digits=3),
                *(Quantity(rate, decimals=DECIMALS) for rate in rates),
                Quantity(level.correlation, digits=3),
                Quantity(level.deviation, digits=3),
            )
        )
    heads = (
        "level", label_with_unit("threshold", study.margin_unit), "samples", "simulations", "probability",
        "cumulative", "accepted: draws", "noise", "lowest source", "gamma", "c.o.v.",
    )  # fmt: skip
    return Table(heads, rows)


def _design_nodes(study: RareOutcome) -> list[Node]:
    if not study.failures:
        return [Text("no simulation failed")]
    noise = ""
    if study.noise.sources:
        noise = " The distance does not include the noise; numbers of components name the trial whose noise they have."
    return [
        Figures(partial(design_figures, study), DESIGN_LEGEND),
        design_table(study),
        Note(
            "Most probable points of failure among the simulations: the distance beta is in standard deviations from "
            "the medians of all dispersed parameters, as independent normal ones. Points nearer than 1 to a more "
            f"probable one are left out.{noise}"
        ),
        Only(Medium.PAGE, partial(_influence, study)),
    ]


def design_table(study: RareOutcome) -> Table:
    """Return a row for each design point: distance, limit state, dispersed parameters, noise of each component."""
    names, sources, units = study.space.names, study.noise.sources, study.units
    rows: list[tuple[Cell, ...]] = [
        (
            entry["trial"],
            Quantity(entry["distance"], digits=3),
            Quantity(entry["margin"], study.margin_unit, is_bare=True),
            *(Quantity(entry["draws"][name], units.get(name), 6, is_bare=True) for name in names),
            *(entry["streams"][source] for source in sources),
        )
        for entry in study.failures
    ]
    heads = (
        "point",
        "beta",
        label_with_unit("limit state", study.margin_unit),
        *(label_with_unit(name, units.get(name)) for name in names),
        *(f"noise of {source}" for source in sources),
    )
    return Table(heads, rows)


def _influence(study: RareOutcome) -> list[Node]:
    rows = [(name, Quantity(shift, digits=3)) for name, shift in influence(study).items()]
    if not rows:
        return []
    return [
        Table(("parameter", "shift, standard deviations"), rows),
        Note(
            "How far failures lie from the campaign's own samples (level 1), parameter by parameter. "
            "The panels show the first three in pairs."
        ),
    ]


def _replays(study: RareOutcome, folder: Path | None) -> list[tuple[str, str]]:
    """Return commands with their purposes: the replay of stored design points, and Monte Carlo for a lower bound."""
    command = study.replay(folder, 0) if study.failures else ""
    replays = [("design point 0; trial K of the file is design point K", command)] if command else []
    if study.monte_carlo:
        replays.append(("a bound ten times lower, by Monte Carlo", study.monte_carlo))
    return replays
