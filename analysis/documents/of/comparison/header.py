"""First nodes on the page of a comparison: verdicts, significant differences, conditions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ....commands.campaigns import batch_of_folder
from ...cell import Code, Inline, LegendEntry, Quantity
from ...common.colours import Look
from ...common.quantities import MINUS
from ...model import Commands, Fold, Items, KeyNumbers, Missing, Node, Note, Repeat, Text
from ..campaign.replays import anchors_of
from ..campaign.verdicts import unjudged_node, verdict_nodes
from .content import ComparisonContent
from .variant_differences import Sentence, significant_differences


def header_nodes(content: ComparisonContent, command: str) -> list[Node]:
    """Return verdicts, significant differences, conditions, and the ``command`` that repeats the comparison."""
    compared = content.comparison
    first: Mapping[str, Any] = compared.first.document
    description = first["description"].removesuffix(".")
    return [
        *([Text(["", description], "lead")] if description else []),
        *([] if compared.has_requirements else [unjudged_node()]),
        *verdict_nodes(content.verdicts, content.styles, anchors_of(content.replays)),
        Text([
            "a trial is a success when ",
            Code(first["success"]),
            ". All variants have the same dispersed inputs",
        ]),
        *(_difference_nodes(content) if compared.pairs else []),
        Repeat(command),
        *_batch_nodes(content),
        KeyNumbers([
            ("system", first["system"]),
            ("variants", len(compared.contenders)),
            ("trials of each", first["trials"]),
            ("seed", first["seed"]),
            ("step", Quantity(first["step"], "s")),
            ("perilune", first["perilune"]),
        ]),
        *_condition_notes(content),
        *(Missing(["", note]) for note in compared.notes),  # preserves a lower-case initial of a folder's name
    ]  # fmt: skip


def _batch_nodes(content: ComparisonContent) -> list[Node]:
    """Return the commands of the batches whose folders have a manifest."""
    commands = {name: batch_of_folder(batch.folder) for name, batch in content.comparison.batches.items()}
    entries = [(name, command) for name, command in commands.items() if command]
    return [Fold("Command of each compared batch", [Commands(entries)])] if entries else []


def _difference_nodes(content: ComparisonContent) -> list[Node]:
    sentences = significant_differences(content.comparison, content.rate_groups, content.metric_groups)
    nodes: list[Node] = [_list_sentences(sentences.first, content.styles)] if sentences.first else []
    if sentences.others:
        summary = f"Pairs without the reference that differ significantly: {len(sentences.others)}"
        nodes.append(Fold(summary, [_list_sentences(sentences.others, content.styles)]))
    pairs = "pair with the reference" if sentences.others else "pair"
    equal = "" if sentences.first else f"No {pairs} differs significantly in {', '.join(sentences.tested)}. "
    note = (
        f"A {MINUS} B: success in percentage points, metrics as the median of the differences of each trial, "
        "with 95 % intervals. Significant: at the 5 % level for all pairs and quantities together (Holm)."
    )
    return [*nodes, Note(equal + note)]


def _list_sentences(sentences: Sequence[Sentence], styles: Mapping[str, Look]) -> Items:
    return Items([_sentence(each, styles) for each in sentences], "differences")


def _sentence(sentence: Sentence, styles: Mapping[str, Look]) -> list[Inline]:
    a, b = (LegendEntry(styles[label], [label]) for label in (sentence.a, sentence.b))
    words = [inline for difference in sentence.differences for inline in (", ", *difference)][1:]
    return [a, f" {MINUS} ", b, ": ", *words, "."]


def _condition_notes(content: ComparisonContent) -> list[Node]:
    """Return parameter sets (of each batch, if there are several), faults and assumptions."""
    compared = content.comparison
    has_several = len(compared.batches) > 1
    notes: list[Node] = []
    if has_several:
        for name, batch in compared.batches.items():
            campaign = Code(batch.document["campaign"])
            sets = parameter_sets(batch.document["parameter_sets"])
            notes.append(Note([f"{name}: campaign ", campaign, ", parameter sets ", sets, "."]))
    if compared.has_faults:
        for name, batch in compared.batches.items():
            faults = Code("; ".join(batch.faults))
            words = f"{name}: with" if has_several else "With"
            notes.append(Note([f"{words} faults: ", faults, "."] if batch.faults else f"{name}: without faults."))
    for name, batch in compared.batches.items():
        words = f"{name}: assumed" if has_several else "Assumed"
        assumptions: Sequence[str] = batch.document.get("assumptions", [])
        notes += [Note(f"{words}: {assumption}.") for assumption in assumptions]
    return notes


def parameter_sets(names: Sequence[str]) -> Inline:
    """Return the parameter sets of a batch."""
    return Code(", ".join(names)) if names else "none except the system's own"
