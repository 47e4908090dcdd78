"""Descriptions of systems with declared figures."""

import re
from functools import cache

from perilune.common.paths import SYSTEMS


@cache
def shipped_ssd(name):
    """Return the text of a shipped system's SSD, which a build composes."""
    return (SYSTEMS / name / "SystemStructure.ssd").read_text(encoding="utf-8")


def with_frames(ssd, inside):
    """Return the description with these elements of Frames instead of those it has, each on its line."""
    whole = re.search(r"( *<Frames [^>]*>\n).*?( *</Frames>\n)", ssd, flags=re.DOTALL)
    return f"{ssd[: whole.end(1)]}{inside}\n{ssd[whole.start(2) :]}"


def with_report(ssd, inside, frames=""):
    """Return the description with these elements of Report and Frames as its annotations, on separate lines."""
    names = f'<Frames xmlns="https://perilune.org/frames">{frames}</Frames>'
    note = (
        "<ssd:Annotations>"
        + (f'<ssc:Annotation type="org.perilune.frames">{names}</ssc:Annotation>' if frames else "")
        + '<ssc:Annotation type="org.perilune.report">\n'
        f'<Report xmlns="https://perilune.org/report">\n{inside}\n</Report>\n'
        "</ssc:Annotation></ssd:Annotations>"
    )
    end = "</ssd:SystemStructureDescription>"
    begin = ssd.find("<ssd:Annotations>", ssd.find("</ssd:DefaultExperiment>"))
    return (ssd[:begin] if begin > 0 else ssd.removesuffix("\n").removesuffix(end)) + f"{note}\n{end}\n"
