"""Document of one run: termination, limits, scene, declared figures, trajectory, all signals, provenance."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

from ....runtime.flight.results import FlightResult
from ...cell import Code, Quantity
from ...figures.declared import FigureDeclaration
from ...figures.scene.scene_elements import SceneFigure
from ...model import (
    Document,
    Group,
    Items,
    KeyNumbers,
    Medium,
    Missing,
    Node,
    Note,
    Only,
    Printed,
    Repeat,
    Section,
    Text,
    Verdict,
)
from ...pictures import Blocks, Scene
from ...scene.notes import scene_notes
from ...scene.picture import draw_ends
from ...scene.view import scene_view
from ..origin import condition_notes, digest_table
from .figures.groups import FigureGroup, figure_groups, joint_findings
from .figures.limits import LimitVerdict, limit_document
from .final_values import final_values, signal_table
from .histories import time_histories
from .nodes import trajectory_nodes
from .notebook_summary import notebook_nodes

if TYPE_CHECKING:  # the layout of diagrams starts a JavaScript engine
    from ...diagram.diagram import BlockDiagram

ENDINGS = {
    "finished": "Nominal termination: end-of-run flag raised",
    "stop_time": "Reached stop time; no end condition triggered",
    "terminated": "Terminated by an FMU",
    "nonfinite": "Aborted: a component returned a value that is not finite",
    "failed": "Aborted: an FMU reported an error or rejected a parameter",
    "timed_out": "Aborted: wall-clock time limit exceeded",
    "crashed": "Aborted: an FMU ended its process",
    "hung": "Aborted: a call of an FMU did not return",
    "out_of_memory": "Aborted: the process of an FMU exceeded its memory limit",
    "interrupted": "Aborted: interrupted from the keyboard",
}


@dataclass(frozen=True, kw_only=True)
class RunContext:
    """System and command of a run, as stated in its document.

    ``figures`` are the figures declared by the SSD. ``draw_diagram`` returns the block diagram. ``command`` repeats the
    run. ``lines`` are the lines of a terminal.
    """

    title: str
    figures: Sequence[FigureDeclaration] = ()
    draw_diagram: Callable[[], BlockDiagram] | None = None
    command: str = ""
    lines: Sequence[str] = ()


def run_document(result: FlightResult, context: RunContext, json: object = None) -> Document:
    """Return the document of a run; its page is composed only when it is written."""

    @cache
    def groups() -> tuple[list[Group], list[FigureGroup]]:
        return figure_groups(context.figures, result, result.provenance["system"])

    return Document(
        context.title,
        [
            Printed(context.lines),
            Only(Medium.NOTEBOOK, lambda: notebook_nodes(result, context.figures)),
            Only(Medium.PAGE, lambda: _header(result, context, groups()[0])),
        ],
        (),
        json,
        page_sections=lambda: _sections(result, context, groups()[1]),
        has_contents=True,
    )


def _header(result: FlightResult, context: RunContext, limits: Sequence[Group]) -> list[Node]:
    provenance = result.provenance
    end = float(result.time[-1]) if result.time.size else None
    return [
        _verdict(result, context.figures),
        *limits,
        KeyNumbers(
            [
                ("system", provenance["system"]),
                ("end time", Quantity(end, "s", 6)),
                ("samples", str(result.time.size)),
                ("communication step", Quantity(provenance["step"], "s")),
                ("algorithm", provenance["algorithm"]),
                ("perilune", provenance["perilune"]),
            ]
        ),
        *([Repeat(context.command)] if context.command else []),
        *condition_notes(provenance),
    ]


def _verdict(result: FlightResult, figures: Sequence[FigureDeclaration]) -> Verdict:
    limits = limit_document(figures, result)
    texts = []
    for verdict in (LimitVerdict.VIOLATED, LimitVerdict.NOT_EVALUATED, LimitVerdict.MET):
        names = [limit["name"] for limit in limits if limit["verdict"] is verdict]
        if names:
            listed = "" if verdict is LimitVerdict.MET else f": {', '.join(names)}"
            texts.append(f"{len(names)} of {len(limits)} limits {verdict}{listed}")
    is_met = all(limit["verdict"] is LimitVerdict.MET for limit in limits)
    return Verdict(
        [ENDINGS[result.status], " (status ", Code(result.status), ")"],
        [
            *([Text(["", result.message.rstrip(".")])] if result.message else []),  # it may begin with a name
            *map(Text, texts),
            *map(Text, joint_findings(figures, result)),
        ],
        is_bad=not (result.complete and is_met),
    )


def _sections(result: FlightResult, context: RunContext, groups: Sequence[FigureGroup]) -> list[Section]:
    scene = _scene(context.figures, result)
    histories = time_histories(result)
    trajectory = trajectory_nodes(result)
    first = [history.subsection() for history in histories.first]
    absent = "all signals are constant" if result.time.size else "no samples recorded"
    sections = []
    if scene is not None:
        sections.append(scene)
    elif trajectory:
        sections.append(Section("Trajectory", trajectory))
    sections += [Section(group.title, group.figures, is_folded=group.is_folded) for group in groups]
    sections.append(Section("Final values", [final_values(result)]))
    if scene is not None and trajectory:
        sections.append(Section("Trajectory", trajectory, is_folded=bool(groups)))
    heading = "States and commands" if histories.are_named else "Time histories"
    sections.append(Section(heading, first or [Missing(absent)], is_folded=bool(groups)))
    if histories.rest:
        others = Note(f"{histories.folded} plots, constant and duplicate signals.")
        folded = [history.subsection() for history in histories.rest]
        sections.append(Section("Other signals", [others, *folded], is_folded=True))
    if context.draw_diagram is not None:
        diagram = context.draw_diagram()
        nodes, broad = [Blocks(diagram)], diagram.is_broad
        sections.append(Section("Block diagram", nodes, is_folded=True, style="whole sheet" if broad else "whole"))
    return [
        *sections,
        Section("All signals", [signal_table(result)], is_folded=True),
        Section("Parameters", _parameters(result.provenance["parameters"]), is_folded=True),
        Section("Provenance", [digest_table(("part", "name"), _files(result.provenance))], is_folded=True),
    ]


def _scene(figures: Sequence[FigureDeclaration], result: FlightResult) -> Section | None:
    """Return the section of the declared scene; None if no scene is declared, or for a run without samples."""
    declared = next((figure for figure in figures if isinstance(figure, SceneFigure)), None)
    view = None if declared is None else scene_view(declared, result)
    if declared is None or view is None:
        return None
    return Section(declared.title, [Scene(view, draw_ends(view), scene_notes(declared, result))], style="screen")


def _parameters(parameters: Mapping[str, float | str]) -> list[Node]:
    if not parameters:
        return [Missing("no parameter was set; all parameters have their FMU defaults")]
    others = "All other parameters have their FMU defaults."
    return [
        Note(f"Values set by the system description, parameter sets and options, in SI units. {others}"),
        Items(
            [
                [f"{name} = ", value if isinstance(value, str) else Quantity(value, digits=10)]
                for name, value in parameters.items()
            ],
            "pairs",
        ),
    ]


def _files(provenance: Mapping[str, Any]) -> list[tuple[str, str, str]]:
    """Return name and SHA-256 of the system and of each component's FMU."""
    fmus = ((component, fmu["fmu"], fmu["sha256"]) for component, fmu in provenance["fmus"].items())
    return [("system", provenance["system"], provenance["system_sha256"]), *fmus]
