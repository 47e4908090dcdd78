"""perilune stability: margins, poles and robustness of a system's loops, with a verdict."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from analysis.reports.stability_page import write_stability_page
from analysis.stability.assessment import decibel, degrees
from analysis.stability.bench import StudyError
from analysis.stability.document import document
from analysis.stability.request import read_request
from analysis.stability.results import LoopReport, Requirement, StabilityReport
from analysis.stability.study import study

from .options import add_json, add_system, system_options, write_json

HELP = "report on the stability of a system's loops"


def add(parser: argparse.ArgumentParser) -> None:
    add_system(parser)
    parser.add_argument(
        "--loop",
        action="append",
        default=[],
        metavar="NAME",
        help="a loop that the SSD names, or COMPONENT.CONNECTOR to cut; default: all that the SSD names",
    )
    parser.add_argument("--at", type=float, metavar="T", help="time of the operating point of a cut, s; default: 0")
    parser.add_argument("--campaign", metavar="NAME", help="disperse the margins over a campaign, by name or .toml")
    parser.add_argument("--trials", type=int, metavar="N", help="fewer or more trials than the campaign says")
    parser.add_argument("--seed", type=int, metavar="S", help="another root seed than the campaign's")
    parser.add_argument("--trial", type=int, metavar="K", help="study the draws of one trial of the campaign instead")
    parser.add_argument(
        "--workers", type=int, metavar="N", help="points studied side by side; default: one per processor"
    )
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures")
    add_json(parser)


def run(options: argparse.Namespace) -> int:
    request = read_request(
        options.system,
        system_options(options),
        loops=options.loop,
        at=options.at,
        campaign=options.campaign,
        trials=options.trials,
        seed=options.seed,
        trial=options.trial,
    )
    try:
        report = study(request, options.workers)
    except StudyError as error:
        print(f"perilune: {request.label}: {error}", file=sys.stderr)
        return 1
    if options.report is not None:
        write_stability_page(report, options.report)
    if not write_json(document(report), options.json):
        for loop in report.loops:
            print(_line(loop))
        for sweep in report.sweeps:
            for quantity, value in sweep.crossings.items():
                print(f"{sweep.name}: {quantity} reaches its limit at {sweep.parameter} = {value:.4g}")
        print(f"{report.system}: {report.verdict}, {report.seconds:.1f} s")
    failures = failed(report)
    for name, item in failures:
        shown = "none" if item.value is None else f"{item.value:.4g} {_unit(item)}".strip()
        print(
            f"perilune: {name}: {item.quantity} {shown} misses the limit {item.limit:g} {_unit(item)}".strip(),
            file=sys.stderr,
        )
    for lost in report.unstudied:
        print(f"perilune: {lost.what} {lost.name} at {lost.point}: not studied: {lost.reason}", file=sys.stderr)
    return 1 if failures or report.unstudied else 0


def failed(report: StabilityReport) -> list[tuple[str, Requirement]]:
    """Every requirement that does not hold, with where."""
    found = []
    for loop in report.loops:
        items = [*loop.requirements, *(loop.dispersion.requirements if loop.dispersion else ())]
        found += [(f"loop {loop.name} at {loop.point}", item) for item in items if item.passed is False]
    for joint in report.joint:
        found += [(f"loops {joint.name} at {joint.point}", item) for item in joint.requirements if item.passed is False]
    return found


def _unit(item: Requirement) -> str:
    return "" if item.unit == "1" else item.unit


def _line(loop: LoopReport) -> str:
    gain, phase = loop.classical.gain_margin, loop.classical.phase_margin
    words = [
        f"{decibel(gain.value):.2f} dB" if gain else "no gain crossing",
        f"{degrees(phase.value):.2f} deg" if phase else "no phase crossing",
        f"modulus {loop.robust.modulus_margin:.3f}",
        f"disk {loop.robust.disk_margin:.3f}",
    ]
    if loop.agreement is not None:
        words.append("routes agree" if loop.agreement.agrees else "routes differ")
    return f"{loop.name} at {loop.point}: {', '.join(words)}: {loop.verdict}"
