"""Correlations of metrics and of success with dispersed inputs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from ....campaigns.draws.interfaces import input_names
from ....campaigns.execute.campaign_result import CampaignResult
from ....studies.sobol import rank_correlations
from ...cell import Cell, Quantity
from ...common.quantities import number
from ...model import Missing, Node, Note, Section, Table
from ...pictures import Figures
from .content import BatchContent
from .scatters import failure_figures, outcome_marks

MOST_INPUTS = 3  # inputs listed for a metric


class CorrelatedInputs(NamedTuple):
    """A metric of a variant with its most correlated inputs: names and rank correlations."""

    variant: str
    metric: str
    inputs: list[tuple[str, float]]


def drivers(result: CampaignResult) -> list[CorrelatedInputs]:
    """Return a row for each metric of each variant with rank correlations, the largest correlation first."""
    names = input_names(result.plan.campaign)
    rows = []
    for variant, sample in result.plotted.items():
        trials = sample.first
        draws = {name: trials.draws[name] for name in names}
        for metric, correlations in rank_correlations(draws, trials.metrics).items():
            known = [(name, rho) for name, rho in correlations.items() if rho is not None]
            known.sort(key=lambda item: -abs(item[1]))
            if known:
                rows.append(CorrelatedInputs(variant, metric, known[:MOST_INPUTS]))
    return rows


def driver_sections(content: BatchContent) -> list[Section]:
    """Return the section on the inputs with which each metric correlates most; no section without correlations."""
    rows = [
        (each.variant, each.metric, ", ".join(f"{name} {number(rho, 2)}" for name, rho in each.inputs))
        for each in drivers(content.batch)
    ]
    if not rows:
        return []
    heads = ("variant", "metric", "inputs, rank correlation")
    note = Note(
        "Spearman rank correlation over all trials with a finite value, up to three inputs. "
        f"|\N{GREEK SMALL LETTER RHO}| < {_significant(content)} is not significant (5 %)."
    )
    nodes: list[Node] = [Table(heads, rows, style="", is_grouped=True), note]
    return [Section("Correlation with dispersed inputs", nodes, is_folded=True)]


def failure_section(content: BatchContent) -> Section:
    """Return the section of failures over the most influential inputs, and of the influence of all inputs."""
    rates = {variant: entry.success_rate for variant, entry in content.batch.summary.items()}
    nodes: list[Node] = []
    for rate, text in ((1.0, "no failures"), (0.0, "all trials failed, so no influence can be computed")):
        variants = [variant for variant, each in rates.items() if each == rate]
        if variants:
            nodes.append(Missing(f"{text}: {', '.join(variants)}"))
    if content.influences:
        nodes += [
            Figures(lambda: failure_figures(content.batch)),
            Note([
                *outcome_marks(), ", over the two most influential inputs of each variant, in the campaign's units."
            ]),
            _influence_table(content.influences, input_names(content.campaign)),
            Note(
                "Influence: larger absolute correlation with success, of the input or of its distance from its mean. "
                f"Values below {_significant(content)} are not significant (5 %)."
            ),
        ]  # fmt: skip
    elif any(0.0 < each < 1.0 for each in rates.values()):
        nodes.append(Missing("no input is dispersed; there is no failure region"))
    return Section("Failure region", nodes)


def _influence_table(influences: Mapping[str, Mapping[str, float]], names: list[str]) -> Table:
    rows: list[tuple[Cell, ...]] = [
        (name, *(Quantity(each.get(name), digits=2) for each in influences.values())) for name in names
    ]
    return Table(("input", *influences), rows, style="")


def _significant(content: BatchContent) -> str:
    """Return the magnitude below which a correlation is not significant (5 %)."""
    return number(2.0 / content.batch.provenance["trials"] ** 0.5, 2)
