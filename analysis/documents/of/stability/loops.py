"""Loops of a stability study, an article each: first margins, Bode and Nichols diagram, the rest folded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ....stability.results.report import LoopReport, StabilityStudy
from ...cell import Faint
from ...common.quantities import MINUS, display_unit
from ...model import Fold, Group, Items, Missing, Node, Note, Repeat, Text, Tile, Tiles
from ...pictures import Figure, Figures
from .figures import OVERVIEW, figures_by_section
from .margins import loop_table
from .paper import Paper, paper_of
from .parts import Part, list_absent, parts
from .shared import TOLERANCE, SharedFigures, share_figures
from .study_cells import anchor, fold_long, link, numeral, omission_text, verdict

SEEN = ("Bode", "Nichols")  # labels of the first figures
HOW_TO_READ = (
    "Frequencies are angular, in rad/s, up to the Nyquist frequency of the loop's sample period. Lines are L; small "
    "circles are the response measured in flight, where L is linearised. Diamonds mark gain margins, squares phase "
    "margins and peaks; the decisive ones are filled.",
    "Bode: bars are the decisive gain and phase margin, read at the dotted frequencies; the short dashed lines are "
    f"the margins required. Nyquist: the cross is {MINUS}1; the solid circle about it is the modulus margin, the "
    "dashed one its limit; dotted curves are the unit circle and negative frequencies; the arrow points to higher "
    f"frequencies. A loop is stable where the whole curve, from {MINUS}π/T to π/T, encircles {MINUS}1 "
    "counter-clockwise as often as the open loop has unstable poles.",
    "Nichols: the hatched diamond is the exclusion zone, with its corners at the required gain and phase margins; "
    "the dashed oval is the limit of the modulus margin.",
    "Sensitivities: S = 1/(1 + L) solid, T = L/(1 + L) dashed; the dashed horizontal line is the limit that the "
    "modulus margin sets on S.",
    "Poles: the solid circle is the unit circle, dotted lines have constant damping (0.2, 0.5, 0.8). Crosses are "
    "modes controllable and observable at the break point; triangles down are not controllable from it, triangles up"
    " not observable at it, squares neither. Poles on or outside the circle are in orange.",
    "Over trials: dashed is the limit, the triangle the worst trial; the hatched bar at the left counts unstable "
    "trials. Crosses are the nominal poles, dots those of all trials.",
    f"Harmonic balance: a limit cycle is predicted where L and {MINUS}1/N meet; filled dots are stable ones, rings "
    "unstable ones.",
    f"Encirclements, counter-clockwise positive: by Nyquist's criterion N of {MINUS}1 and P unstable poles of the "
    f"open loop leave P {MINUS} N unstable closed-loop poles, and stable is P = N. Integrators (z = 1) are passed on "
    "the outside: not among P. Disk margin: gain and phase may vary simultaneously within it.",
)


def loop_nodes(report: StabilityStudy) -> list[Node]:
    """Return the definition of L, explanations of figures and tables, and all loops."""
    figures = [figures_by_section(loop, anchor(index)) for index, loop in enumerate(report.loops)]
    shared = share_figures(report.loops, figures)
    paper = paper_of(shared)
    return [
        Text(
            "L is the negative of the loop transfer function, broken at the point named with each loop: the "
            f"sensitivity is 1/(1 + L), and {MINUS}1 is critical. Each loop is evaluated at its own sample period"
        ),
        Note(paper.words, "paper"),
        Fold("How to read the figures and tables", [Items(HOW_TO_READ, "note")], is_printed=True),
        *(_article(report, index, one, paper) for index, one in enumerate(shared)),
    ]


def _article(report: StabilityStudy, index: int, shared: SharedFigures, paper: Paper) -> Group:
    loop = report.loops[index]
    figures = {key: paper.mark_printed(members) for key, members in shared.figures.items()}
    known = [replace(part, figures=figures.get(part.key, [])) for part in parts(loop)]
    absent = list_absent(loop)
    details = [
        *_figures(figures[""]),
        *_elsewhere(report, shared, at_sight=False),
        Tiles([tile for block in _blocks(known) for tile in _tiles(block, shared, paper)]),
        *([Note(f"Not part of this study for {loop.name}: {', '.join(absent)}.", "screen")] if absent else []),
    ]
    nodes = [
        Note([f"Loop {loop.loop}, sample period ", numeral(loop.sample_period), " s"]),
        loop_table(loop),
        Items([[Faint(name), f" {value}"] for name, value in _cut(loop)], "inline"),
        *(Missing(omission_text(part, reason, loop)) for part, reason in loop.not_applicable.items()),
        *_figures(figures[OVERVIEW]),
        *_elsewhere(report, shared, at_sight=True),
        Fold(f"Plots and details: {loop.name}", details, is_printed=True),
    ]
    return Group([f"{loop.name} at {loop.point} ", verdict(loop.verdict)], nodes, anchor=anchor(index))


def _cut(loop: LoopReport) -> list[tuple[str, str]]:
    """Return where a loop is cut, its sign, and which other loops remain closed."""
    return [
        ("loop broken at", loop.cut),
        ("return signal", "the same connector" if loop.returned == loop.cut else loop.returned),
        ("unit", display_unit(loop.unit) or "1"),
        ("sign", loop.sign),
        ("other loops closed", ", ".join(loop.closed) or "no other loop is declared"),
    ]


def _figures(figures: Sequence[Figure]) -> list[Node]:
    return [Figures(lambda: figures)] if figures else []


def _elsewhere(report: StabilityStudy, shared: SharedFigures, *, at_sight: bool) -> list[Node]:
    """Return a reference to figures shown with another loop: the first ones, or the others."""
    labelled = {
        other: [label for label in labels if (label in SEEN) == at_sight]
        for other, labels in shared.labels_by_loop.items()
    }
    same = f", which is the same within {TOLERANCE} pt, half the width of a line."
    return [
        Note([f"{', '.join(labels)}: see ", link(report, report.loops[other]), same])
        for other, labels in labelled.items()
        if labels
    ]


def _blocks(known: Sequence[Part]) -> list[list[Part]]:
    """Return the parts that are laid out together; short ones next to the long table of the method form one block."""
    blocks: list[list[Part]] = []
    for part in known:
        if part.key != "robust":
            blocks.append([])
        blocks[-1].append(part)
    return blocks


def _tiles(block: Sequence[Part], shared: SharedFigures, paper: Paper) -> list[Tile]:
    """Return a block of parts, with several figures of a part below it, or a single figure next to it."""
    nodes = [
        node
        for part in block
        for node in (_group(part, shared, paper), *(_figures(part.figures) if len(part.figures) > 1 else []))
    ]
    singles = [Tile(_figures(part.figures)) for part in block if len(part.figures) == 1]
    return [Tile(nodes, is_wide=len(block[0].figures) > 1), *singles]


def _group(part: Part, shared: SharedFigures, paper: Paper) -> Group:
    nodes = [
        fold_long(part.table, part.rows),
        *([Note(part.note)] if part.note else []),
        *([Repeat(part.command)] if part.command else []),
    ]
    return Group(part.heading, nodes, level=4, is_printed=paper.is_table_printed(part.key, shared))
