"""Tightest margin of a study: in the header with limit and dispersion, and marked in the tables.

Truth: reserves relative to limits, from the requirements of the report; Clopper and Pearson's interval by scipy.
"""

import math
from dataclasses import replace

import pytest
import scipy

from perilune.analysis.documents.of.reserve import relative_reserve
from perilune.analysis.documents.of.stability.study_document import stability_document
from perilune.analysis.documents.of.stability.tightest import tightest
from perilune.analysis.documents.render.terminal import document_lines
from perilune.analysis.stability.results.requirement import Scope
from tests.support.pages.checks import parse, section_of, text_of


def written(report, folder):
    report.report(folder / "page.html")
    return (folder / "page.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("value", "low", "high", "reserve"),
    [
        (9.0, 6.0, None, 0.5),
        (2.0, None, 4.0, 0.5),
        (-2.0, -10.0, 10.0, 0.8),
        (5.0, 6.0, None, -1.0 / 6.0),
        (1.0, 0.0, None, math.inf),
        (math.nan, None, 4.0, -math.inf),
    ],
)
def test_reserve_is_relative_to_the_limit(value, low, high, reserve):
    assert relative_reserve(value, low, high) == pytest.approx(reserve)


def test_the_least_reserve_is_in_the_header_and_in_the_tables(studies, tmp_path):
    report = studies.pair
    judged = [
        (requirement.value / requirement.limit, subject, requirement)
        for subject, requirement in report.judgements()
        if requirement.title not in ("spectral radius", "share of stable trials")
    ]
    _, subject, requirement = min(judged, key=lambda each: each[0])
    nearest = tightest(report)
    assert (nearest.subject, nearest.requirement) == (subject, requirement)
    page = written(report, tmp_path)
    header = " ".join(parse(page).xpath("//header")[0].text_content().split())
    assert f"Tightest margin: {subject.name} at {subject.point}, {requirement.title} " in header
    assert f", limit {requirement.limit:g}" in header
    assert "Not dispersed: --campaign NAME adds the trials of a campaign." in header
    for heading, name in (("Verdict", requirement.title), ("Margins", subject.name)):
        (row,) = section_of(page, heading).xpath(".//tr[td//b[text()='tightest']]")
        assert name in row.text_content()
    (line,) = (line for line in document_lines(stability_document(report)) if line.startswith("tightest margin: "))
    assert line.startswith(f"tightest margin: {subject.name} at {subject.point}, {requirement.title} ")


def test_an_unstable_trial_is_tighter_than_any_margin(studies, tmp_path):
    spread = studies.late.loops[0].dispersion
    stable = spread.trials - spread.unstable
    low, high = scipy.stats.binomtest(stable, spread.trials).proportion_ci(0.95, method="exact")
    header = " ".join(text_of(written(studies.late, tmp_path)).split())
    assert f"Tightest margin: late at there, unstable in {spread.unstable} of {spread.trials} trials." in header
    assert f"late at there stable in {stable} of {spread.trials} (95 % interval {100 * low:.2f} to " in header
    assert f"{100 * high:.2f} %)" in header


def test_levels_of_the_dispersed_margin_are_in_the_header(studies, tmp_path):
    (loop,) = studies.late.loops
    spread = loop.dispersion
    members = tuple(each for each in spread.margins if not each.unstable)
    limits = tuple(
        replace(each, value=spread.levels(each.quantity)["50 %"], passed=True)
        for each in spread.requirements
        if each.title.endswith("margin")
    )
    calm = replace(spread, margins=members, requirements=limits, worst=0)
    report = replace(studies.late, loops=(replace(loop, dispersion=calm),))
    quantity = tightest(report, (Scope.DISPERSED,)).requirement.quantity
    levels = calm.levels(quantity)
    words = f", {quantity} at least {levels['least']:.4g}, median {levels['50 %']:.4g}"
    assert words in " ".join(text_of(written(report, tmp_path)).split())


def test_unstable_loops_have_no_other_reserve(studies, tmp_path):
    assert tightest(studies.unstable).requirement.scope is Scope.NOMINAL
    assert ", unstable." in text_of(written(studies.unstable, tmp_path))


def test_without_limits_only_stability_is_judged(studies):
    bare = replace(studies.relay, loops=tuple(replace(loop, requirements=()) for loop in studies.relay.loops), joint=())
    assert "no margin has a limit: only stability is judged" in document_lines(stability_document(bare))
