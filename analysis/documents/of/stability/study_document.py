"""Document of a stability study in the order of a review board: verdict, margins, loops, origin."""

from __future__ import annotations

from functools import partial

from ....stability.loops.margin_values import MarginQuantity
from ....stability.results.document import document
from ....stability.results.report import LoopReport, StabilityStudy
from ....stability.results.requirement import MarginVerdict
from ...cell import Strong
from ...model import Document, Group, Medium, Missing, Node, Note, Only, Printed, Repeat, Section, Table, Text, Verdict
from ...pictures import Figure, Figures
from .figures import SIZE, bode_figure, joint_figure
from .loops import loop_nodes
from .margins import joint_table, order_table, summary_table, verdict_table
from .orders import order_sentences
from .over_time import margin_histories, over_time_nodes
from .points import point_nodes
from .printed import stability_lines
from .study_cells import fold_long, gain_margin, phase_margin, size, verdict
from .study_origin import origin_nodes
from .sweeps import sweep_nodes
from .tightest import dispersion_nodes, tightest_nodes, with_mark


def stability_document(report: StabilityStudy, command: str = "") -> Document:
    """Return the document of a study, which ``command`` repeats.

    The computing time is shown only in a terminal, so that the page is reproducible.
    """
    summary: list[Node] = [
        Printed(stability_lines(report)),
        Only(Medium.NOTEBOOK, partial(_notebook_nodes, report)),
        Only(Medium.PAGE, lambda: [_verdict(report), *([Repeat(command)] if command else [])]),
    ]
    histories = margin_histories(report)
    sections = [
        ("Margins over the time of flight", partial(over_time_nodes, histories, report), bool(histories)),
        ("Verdict", partial(_requirement_nodes, report), True),
        ("Undeclared dependencies", partial(_order_nodes, report), bool(_order_notes(report))),
        ("Without margins", partial(_unstudied_nodes, report), bool(report.unstudied)),
        ("Margins", partial(_margin_nodes, report), True),
        ("Operating points", partial(point_nodes, report.points, report.provenance.get("parameters", {})), True),
        ("Loops", partial(loop_nodes, report), True),
        ("Over parameters", partial(sweep_nodes, report), bool(report.sweeps)),
        ("What was studied", partial(origin_nodes, report), True),
    ]
    return Document(
        f"{report.system}: stability",
        summary,
        [Section(heading, [Only(Medium.PAGE, compose)]) for heading, compose, is_there in sections if is_there],
        document(report),
        has_contents=True,
    )


def decisive_loop(report: StabilityStudy) -> LoopReport:
    """Return the first loop that fails, else the first."""
    return next((loop for loop in report.loops if loop.verdict is MarginVerdict.FAIL), report.loops[0])


def _notebook_nodes(report: StabilityStudy) -> list[Node]:
    """Return the verdict, the nearest margins of each loop, and the Bode diagram of the decisive loop."""
    heads = ("loop", "operating point", "gain margin, dB", "phase margin, deg", "modulus", "disk", "")
    rows = [
        (
            with_mark(report, loop, loop.name),
            loop.point,
            gain_margin(loop.margins),
            phase_margin(loop.margins),
            *(size(loop.margins.size(quantity)) for quantity in (MarginQuantity.MODULUS, MarginQuantity.DISK)),
            verdict(loop.verdict),
        )
        for loop in report.loops
    ]

    def bode() -> list[Figure]:
        loop = decisive_loop(report)
        return [bode_figure(loop, f"{loop.name} at {loop.point}", "bode", SIZE)]

    return [
        Text(str(report.verdict)),
        *tightest_nodes(report),
        *dispersion_nodes(report),
        *map(Text, order_sentences(report)),
        *(Text(f"{item.name} at {item.point} not studied") for item in report.unstudied),
        Table(heads, rows),
        *([Figures(bode)] if report.loops else []),
    ]


def _verdict(report: StabilityStudy) -> Verdict:
    verdicts = [item.requirement.verdict for item in report.judgements()]
    words = {
        MarginVerdict.FAIL: "violated",
        MarginVerdict.WITHHELD: "withheld",
        MarginVerdict.NOT_APPLICABLE: "not applicable",
    }
    others = [f"{verdicts.count(each)} {text}" for each, text in words.items() if each in verdicts]
    met = f"{verdicts.count(MarginVerdict.PASS)} of {len(verdicts)} requirement{'s' if len(verdicts) != 1 else ''} met"
    nodes = [Text(", ".join([met, *others])), *tightest_nodes(report), *dispersion_nodes(report)]
    return Verdict([verdict(report.verdict)], nodes, is_bad=report.verdict is not MarginVerdict.PASS)


def _requirement_nodes(report: StabilityStudy) -> list[Node]:
    judgements = list(report.judgements())
    if not judgements:
        return [Missing("the system declares no requirement")]
    everything = fold_long(verdict_table(report, judgements), "requirements")
    failing = [item for item in judgements if item.requirement.verdict in (MarginVerdict.FAIL, MarginVerdict.WITHHELD)]
    if not failing:
        return [everything]
    is_withheld = any(item.requirement.verdict is MarginVerdict.WITHHELD for item in failing)
    heading = "Violated or withheld requirements" if is_withheld else "Violated requirements"
    return [Group(heading, [verdict_table(report, failing)]), Group("All requirements", [everything])]


def _order_notes(report: StabilityStudy) -> list[str]:
    if report.orders is None:  # FMUs that are outside all loops
        return [f"Assumed: {note}." for note in report.provenance.get("assumptions", ())]
    return [f"{sentence[0].upper()}{sentence[1:]}." for sentence in order_sentences(report)]


def _order_nodes(report: StabilityStudy) -> list[Node]:
    table = order_table(report)
    nodes: list[Node] = [Note(each) for each in _order_notes(report)]
    if table.rows:
        reading = Note(
            "A requirement passes where it passes in both orders and fails where it fails in both; otherwise it is "
            "withheld. The other figures and tables of this page are without feedthrough."
        )
        nodes += [table, reading]
    return nodes


def _unstudied_nodes(report: StabilityStudy) -> list[Node]:
    return [
        Text([
            f"{item.what} ", Strong(item.name),
            f" at {item.point}: {item.text}{': fail' if item.verdict is MarginVerdict.FAIL else ''}",
        ])
        for item in report.unstudied
    ]  # fmt: skip


def _margin_nodes(report: StabilityStudy) -> list[Node]:
    nearest = Note(
        "The gain margin is the upper or lower margin nearest to 0 dB, and the phase margin is the margin "
        "nearest to 0. "
        "Delay margins in samples count the loop's sample period. One loop is opened at a time, all others closed. "
        "Tightest: least reserve relative to its limit."
    )
    joint = Group(
        "Simultaneous (multi-loop) margins",
        [
            joint_table(report),
            Figures(lambda: [joint_figure(each, f"joint-{index + 1}") for index, each in enumerate(report.joint)]),
            Note(
                "Gain and phase of all channels vary simultaneously and independently, each by at most the values "
                "given. Square: the minimum margin; dashed: the disk margin that the required gain and phase margins "
                "imply."
            ),
        ],
    )
    single: list[Node] = [summary_table(report), nearest] if report.loops else [Missing("the study has no loop")]
    return [*single, *([joint] if report.joint else [])]
