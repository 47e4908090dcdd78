"""Every kind of page on a telephone: what its figures say can be read, and nothing runs out of the screen.

Truth: the heights and widths that a browser lays out; 8.5 px is what a telephone's own small print has.
"""

import pytest

from perilune.analysis.design.trajectories.vehicle import HOVER_TRANSFER, HOVER_VEHICLE
from perilune.analysis.design.transfers.hover_study import hover_study
from perilune.analysis.reports.campaign.batch_report import write_batch_report
from perilune.analysis.reports.plan_pages import write_hover_page
from perilune.analysis.reports.run_report import write_run_report
from tests.support.lengths import either
from tests.support.pages.narrow import PHONE, assert_legible, measure
from tests.support.pages.own_samples import ANGLES, ERROR, PULSES, angles, errors, flown, pulses
from tests.support.pages.samples import mixed_batch, run_result


def write_flight(page):
    write_run_report(run_result(), page, "Flight")


def write_figures_of_its_own(page):
    write_run_report(flown(angles=angles(), **pulses(), **errors()), page, "Own", [ANGLES, PULSES, ERROR])


def write_batch(page):
    write_batch_report(mixed_batch(), page, "Batch")


def write_plan(page):
    write_hover_page(hover_study(HOVER_VEHICLE, HOVER_TRANSFER, curves=True), page)


PAGES = (write_flight, write_figures_of_its_own, write_batch, write_plan)


@pytest.mark.parametrize("write", either(PAGES, (write_flight,)))
def test_pages_are_legible_on_a_telephone(browser, tmp_path, write):
    write(tmp_path / "page.html")
    assert_legible(browser, tmp_path / "page.html", tmp_path)


def test_a_comparison_is_legible_on_a_telephone(browser, tmp_path, comparison):
    assert_legible(browser, comparison / "page.html", tmp_path)


def test_a_stability_page_is_legible_on_a_telephone(browser, tmp_path, stability_page):
    assert_legible(browser, stability_page, tmp_path)


@pytest.mark.slow
def test_a_mission_is_legible_on_a_telephone(browser, tmp_path, mission_page):
    assert_legible(browser, mission_page, tmp_path)


def test_a_narrow_screen_shows_the_figure_that_was_drawn_for_it(browser, tmp_path, mission_page):
    narrow = measure(browser, mission_page, tmp_path, PHONE)
    assert narrow.smallest == pytest.approx(8.0 * (PHONE - 24) / (4.5 * 72), rel=0.01)  # 8 pt of 4.5 in, 12 px of edge
    just, no_more = (measure(browser, mission_page, tmp_path, width) for width in (861, 860))  # px, see page.css
    assert min(just.smallest, no_more.smallest) >= 8.5
