"""Pages that several tests look at, written without a warning."""

import warnings
from pathlib import Path

from perilune.analysis.campaigns.compare.side_by_side import compare
from perilune.analysis.reports.compare.page import write_comparison_page
from perilune.analysis.reports.run_report import write_run_report
from tests.support.loops.studies import Studies
from tests.support.pages.comparison_samples import write_sample
from tests.support.pages.mission_samples import FIGURES, mission

COMMAND = "perilune compare something"


def write_studies(studies: Studies, folder: Path) -> None:
    """Write page.html: a study with all that a page can show."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        studies.everything.report(folder / "page.html")


def write_comparison(folder: Path) -> None:
    """Write quiet, a batch of three variants, and page.html, which compares them."""
    write_sample(folder / "quiet")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        write_comparison_page(compare([folder / "quiet"]), folder / "page.html", COMMAND)


def write_mission(folder: Path) -> None:
    """Write page.html: a flight through phases."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        write_run_report(mission(), folder / "page.html", "Mission", FIGURES)
