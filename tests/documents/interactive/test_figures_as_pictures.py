"""Every figure of every kind of page shows with scripts the same content as its picture without scripts.

Truth: the picture drawn by matplotlib: its texts and their positions, its lines at ten instants, its ink. This file
lists figures that remain pictures, and the template of each kind of page: a template added to the product is reported
as untested until a kind of page uses it. Pages inside FMUs have no figure, a law has a drawing instead of a page, and
results in notebooks have one picture.
"""

import functools
import operator
from dataclasses import replace

import numpy as np
import pytest

from docs.figures.demo import fly
from perilune.analysis.design.trajectories.landing_study import landing_study
from perilune.analysis.design.trajectories.vehicle import HOVER_TRANSFER, HOVER_VEHICLE
from perilune.analysis.design.transfers.hover_study import hover_study
from perilune.analysis.differences.differences import compare_runs
from perilune.analysis.differences.recorded_run import RecordedRun
from perilune.analysis.documents.of.design.landing_bound import landing_bound_document
from perilune.analysis.documents.of.design.transfer import transfer_document
from perilune.analysis.documents.of.differences import differences_document
from perilune.analysis.documents.render.html import write_document
from perilune.common.paths import ROOT
from tests.documents.of.test_plan_pages import LANDER, LANDING
from tests.support.documents.run_page import write_run_report
from tests.support.lengths import either
from tests.support.pages.own_samples import ANGLES, ERROR, PULSES, angles, errors, flown, pulses
from tests.support.pages.pictures.reading import read_page, reading
from tests.support.pages.samples import mixed_batch, run_result, write_batch_page


def write_run(request, page):
    result = run_result()
    large = {"ship.throttle": 1e4 * result["ship.tilt"]}  # whose ticks have five digits
    write_run_report(replace(result, signals=result.signals | large, units=result.units | {"ship.throttle": None},
                             types=result.types | {"ship.throttle": "Real"}), page, "Flight")  # fmt: skip


def write_own(request, page):
    write_run_report(flown(angles=angles(), **pulses(), **errors()), page, "Own", [ANGLES, PULSES, ERROR])


def write_mission(request, page):
    page.write_bytes(request.getfixturevalue("mission_page").read_bytes())


def write_batch(request, page):
    write_batch_page(mixed_batch(), page, "Batch")


def write_comparison(request, page):
    page.write_bytes((request.getfixturevalue("comparison") / "page.html").read_bytes())


def write_stability(request, page):
    page.write_bytes(request.getfixturevalue("stability_page").read_bytes())


def write_rare(request, page):
    request.getfixturevalue("rare_result").report(page)


def write_worst(request, page):
    request.getfixturevalue("worst_result").report(page)


def write_sensitivity(request, page):
    request.getfixturevalue("sensitivity_result").report(page)


def write_transfer(request, page):
    write_document(transfer_document(hover_study(HOVER_VEHICLE, HOVER_TRANSFER)), page)


def write_bound(request, page):
    write_document(landing_bound_document(landing_study(LANDER, LANDING, intervals=40)), page)


def write_differences(request, page):
    time = np.linspace(0.0, 10.0, 101)
    runs = []
    for turn in (1.0, 1.1):
        signals = {"h": np.sin(turn * time), "v[1]": 0.0 * time, "v[2]": turn * time, "v[3]": turn - time}
        runs.append(RecordedRun("run", "", time, signals, dict.fromkeys(signals, "m"), frozenset()))
    write_document(differences_document(compare_runs(*runs), 1e-9), page)


def write_landing(request, page):
    page.write_bytes((request.getfixturevalue("flight") / "page.html").read_bytes())


def write_many_trials(request, page):
    page.write_bytes((request.getfixturevalue("batch") / "page.html").read_bytes())


def write_recorded(request, page):
    page.write_bytes((request.getfixturevalue("recorded") / "page.html").read_bytes())


def write_demo(request, page):
    request.getfixturevalue("fmus")
    page.write_bytes(fly(page.parent / "demo", 24).read_bytes())


# Each kind of page with the beginnings of the names of figures that remain pictures.
KINDS = {
    write_run: [],
    write_own: [],
    write_mission: [],
    write_batch: [],
    write_comparison: [],
    write_stability: [],
    write_rare: [],
    write_worst: [],
    write_sensitivity: [],
    write_transfer: [],
    write_bound: [],
    write_differences: [],
}
SHIPPED = {  # pages of our systems
    write_landing: [],
    write_many_trials: [],
    write_recorded: [],
    write_demo: [],
}
PAGES = either(
    KINDS | SHIPPED,
    {write: KINDS[write] for write in (write_run, write_own, write_batch, write_stability, write_worst)},
)


TEMPLATES = {
    "document.html": [
        write_run,
        write_own,
        write_mission,
        write_landing,
        write_comparison,
        write_stability,
        write_batch,
        write_many_trials,
        write_recorded,
        write_differences,
        write_rare,
        write_worst,
        write_sensitivity,
        write_transfer,
        write_bound,
    ],
    "demo.html": [write_demo],
    "show.html": [],  # without scripts it has no figure: tests/show
}


@pytest.fixture(scope="module", params=either([False, True], [False]), ids=lambda phone: "390" if phone else "1400")
def reader(request, browser):
    with reading(browser, phone=request.param) as driver:
        yield driver


@pytest.mark.parametrize("write", PAGES, ids=lambda write: write.__name__.removeprefix("write_"))
def test_figures_say_what_their_pictures_say(request, reader, tmp_path, write):
    write(request, tmp_path / "page.html")
    compared = read_page(reader, tmp_path / "page.html")
    assert not compared.differences
    assert compared.answering
    stated = {begin: [name for name in compared.pictures if name.startswith(begin)] for begin in PAGES[write]}
    assert all(stated.values()), stated
    assert sorted(functools.reduce(operator.iadd, stated.values(), [])) == sorted(compared.pictures)
    assert compared.marks > 0 or write is write_sensitivity


def test_every_template_of_a_page_has_its_kinds():
    folders = [ROOT / name for name in ("analysis", "docs", "fmus_src")]
    templates = [path for folder in folders for path in folder.rglob("*.html")]
    pages = [path.name for path in templates if '{% extends "base.html" %}' in path.read_text(encoding="utf-8")]
    assert sorted(pages) == sorted(TEMPLATES)
    assert set().union(*TEMPLATES.values()) == set(KINDS | SHIPPED)
