"""Document of a search for a law: its end, the chosen law, the Pareto set."""

from __future__ import annotations

from ....design.synthesis.synthesis_outcome import SynthesisOutcome
from ...cell import Cell, Phrase, Quantity
from ...model import Document, KeyNumbers, Section, Table, Text, Verdict
from .law import formula_nodes
from .law_figures import law_diagram


def synthesis_document(result: SynthesisOutcome) -> Document:
    """Return the document of a search, which may be unfinished."""
    state, chosen, law = result.search.state, result.search.choose(), result.law
    evaluation = chosen.evaluation
    verdict = Verdict(
        f"chosen: {evaluation.successes} of {evaluation.flown} trials are successes",
        [Text(result.objectives_text(chosen))],
        is_bad=not result.succeeded,
    )
    numbers: list[tuple[str, Cell]] = [
        ("laws evaluated", state.evaluations),
        ("simulations", state.flights),
        ("generations", state.generation),
        ("ended by", result.ended),
        ("in the Pareto set", len(state.front)),
    ]
    sections = [
        Section("Chosen law", [*formula_nodes(law), law_diagram(law)]),
        Section("Pareto set", [_pareto_set(result)]),
    ]
    return Document(f"Search for a law: {law.name}", [verdict, KeyNumbers(numbers)], sections, result.content())


def _pareto_set(result: SynthesisOutcome) -> Table:
    """Return successes and objectives, ordered by the first objective."""
    rows: list[list[Cell]] = [
        [
            Phrase([f"{candidate.evaluation.successes} of {candidate.evaluation.flown}"]),
            *(Quantity(numbers["mean"], digits=6) for numbers in result.objectives(candidate).values()),
        ]
        for candidate in result.pareto_set()
    ]
    return Table(["successes", *(f"{name} per flight" for name in result.synthesis.objectives)], rows)
