"""Pages shared by several tests, written without warnings."""

import warnings
from pathlib import Path

from perilune.analysis.campaigns.compare.side_by_side import compare
from perilune.analysis.documents.of.comparison.comparison import comparison_document
from perilune.analysis.documents.render.html import write_document
from tests.support.documents.run_page import write_run_report
from tests.support.loops.studies import Studies
from tests.support.pages.comparison_samples import write_sample
from tests.support.pages.mission_samples import FIGURES, mission

COMMAND = "perilune compare something"


def write_studies(studies: Studies, folder: Path) -> None:
    """Write page.html: a study with all that a page can show."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        studies.everything.report(folder / "page.html")


def write_comparison_page(folders, page, reference=None):
    """Write the page that compares the batches in some folders, and return its text."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        write_document(comparison_document(compare(folders, reference), COMMAND), page)
    return page.read_text(encoding="utf-8")


def write_comparison(folder: Path) -> None:
    """Write quiet, a batch of three variants, and page.html, which compares them."""
    write_sample(folder / "quiet")
    write_comparison_page([folder / "quiet"], folder / "page.html")


def write_mission(folder: Path) -> None:
    """Write page.html: a flight through phases."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        write_run_report(mission(), folder / "page.html", "Mission", FIGURES)
