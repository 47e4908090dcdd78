"""Every kind of page on a phone and on a wide screen: figures are legible, and nothing overflows the screen.

Truth: heights and widths in the layout of a browser; text in figures has at least 11 px.
"""

import pytest

from perilune.analysis.design.trajectories.vehicle import HOVER_TRANSFER, HOVER_VEHICLE
from perilune.analysis.design.transfers.hover_study import hover_study
from perilune.analysis.documents.of.design.transfer import transfer_document
from perilune.analysis.documents.render.html import write_document
from tests.support.documents.run_page import write_run_report
from tests.support.lengths import either
from tests.support.pages.narrow import assert_legible
from tests.support.pages.own_samples import ANGLES, ERROR, PULSES, angles, errors, flown, pulses
from tests.support.pages.samples import mixed_batch, run_result, write_batch_page


def write_flight(page):
    write_run_report(run_result(), page, "Flight")


def write_figures_of_its_own(page):
    write_run_report(flown(angles=angles(), **pulses(), **errors()), page, "Own", [ANGLES, PULSES, ERROR])


def write_batch(page):
    write_batch_page(mixed_batch(), page, "Batch")


def write_plan(page):
    write_document(transfer_document(hover_study(HOVER_VEHICLE, HOVER_TRANSFER)), page)


PAGES = (write_flight, write_figures_of_its_own, write_batch, write_plan)


@pytest.mark.parametrize("write", either(PAGES, (write_flight,)))
def test_pages_are_legible_on_a_telephone(browser, tmp_path, write):
    write(tmp_path / "page.html")
    assert_legible(browser, tmp_path / "page.html", tmp_path)


@pytest.mark.slow
def test_a_comparison_is_legible_on_a_telephone(browser, tmp_path, comparison):
    assert_legible(browser, comparison / "page.html", tmp_path)


def test_a_stability_page_is_legible_on_a_telephone(browser, tmp_path, stability_page):
    assert_legible(browser, stability_page, tmp_path)


@pytest.mark.slow
def test_a_mission_is_legible_on_a_telephone(browser, tmp_path, mission_page):
    assert_legible(browser, mission_page, tmp_path)
