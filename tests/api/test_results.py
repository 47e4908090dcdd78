"""Batches, comparisons, studies and laws in Python: tables, plots, and their display in notebooks.

Truth: the numbers of the results, and for margins the closed form of the frequency response.
"""

from __future__ import annotations

import numpy as np
import pytest
from lxml import html

import perilune
from perilune.analysis.campaigns.summary import success_interval
from perilune.analysis.verbs.validate import FileCheck
from tests.api.test_flights import pictures

pytestmark = pytest.mark.usefixtures("fmus")
TRIALS = 40
COMPARED = ["analytic_guidance", "astar_guidance"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("batch") / "results"


@pytest.fixture(scope="module")
def batch(fmus, folder):
    return perilune.batch(
        "lunar_terminal_guidance", "paper", trials=TRIALS, compare={"guidance": COMPARED}, output=str(folder)
    )


@pytest.fixture(scope="module")
def study(fmus):
    return perilune.stability("hover_transfer", loops=["attitude_x"])


def test_a_batch_as_a_table(batch):
    table = batch.to_pandas()
    assert len(table) == TRIALS * len(COMPARED)
    for name in COMPARED:
        own = table[table["variant"] == name]
        assert own["success"].mean() == batch.summary[name].success_rate
        good = own[own["success"]]["metric.position_error"]
        assert np.mean(good) == pytest.approx(batch.summary[name].metrics["position_error"].mean, rel=1e-12)
    assert repr(batch).startswith("BatchResult(lunar_terminal_guidance, 40 trials: analytic_guidance 100 %")


def test_a_notebook_shows_a_batch(batch):
    text = batch._repr_html_()
    page = html.fromstring(text)
    rate = page.xpath("(//table)[1]/tbody/tr[2]/td")
    successes = int(batch.trials[COMPARED[1]].success.sum())
    assert float(rate[2].text) == pytest.approx(100.0 * successes / TRIALS, rel=1e-3)
    ends = [float(end) for end in rate[3].text.split(" to ")]
    np.testing.assert_allclose(ends, 100.0 * np.array(success_interval(successes, TRIALS)), rtol=1e-3)
    assert len(pictures(text)) == 1


def test_metrics_by_name(batch):
    figure = batch.plot("flight_time")
    line = figure.axes[0].lines[0]
    values = np.sort(batch.trials[COMPARED[0]].metrics["flight_time"])
    np.testing.assert_array_equal(line.get_xdata()[1:-1], values)
    with pytest.raises(KeyError, match=r"no metric flight_tim; use one of .*flight_time"):
        batch.plot("flight_tim")


def test_results_are_not_written_over_without_a_word(batch, folder):
    with pytest.raises(perilune.InputError, match="holds results already"):
        perilune.batch("lunar_terminal_guidance", "paper", trials=1, output=folder)


def test_a_comparison(batch, folder, tmp_path):
    comparison = perilune.compare(str(folder), reference=COMPARED[1])
    assert comparison.pairs == [(COMPARED[0], COMPARED[1])]
    table = comparison.to_pandas().set_index(["metric", "variant"])
    assert table.loc[("flight_time", COMPARED[0]), "mean"] == pytest.approx(
        np.mean(batch.trials[COMPARED[0]].metrics["flight_time"]), rel=1e-12
    )
    text = comparison._repr_html_()
    assert COMPARED[1] in html.fromstring(text).text_content()
    assert len(pictures(text)) == 1
    comparison.plot("flight_time")
    with pytest.raises(KeyError, match="no metric flight"):
        comparison.plot("flight")
    with pytest.raises(perilune.InputError, match="no results folder is given"):
        perilune.compare()


def test_a_study(study, tmp_path):
    loop = study.loop("attitude_x")
    assert np.abs(1.0 + loop.curve.value).min() == pytest.approx(loop.robust.modulus_margin, rel=1e-2)
    row = study.to_pandas().loc[("attitude_x", loop.point)]
    assert row["modulus_margin"] == loop.robust.modulus_margin
    assert row["phase_margin_deg"] == pytest.approx(np.degrees(loop.classical.phase_margin.value))
    page = html.fromstring(study._repr_html_())
    assert "attitude_x" in page.text_content()
    study.report(tmp_path / "page.html")
    assert (tmp_path / "page.html").is_file()
    with pytest.raises(KeyError, match="no loop attitude; use one of attitude_x"):
        study.loop("attitude")
    with pytest.raises(KeyError, match="attitude_x is not studied at landing; use one of"):
        study.plot_bode("attitude_x", "landing")


def test_diagrams_of_a_loop(study):
    loop = study.loop("attitude_x")
    gain = max(study.plot_bode().axes[0].lines, key=lambda line: len(line.get_ydata()))  # others are rules and marks
    np.testing.assert_allclose(gain.get_ydata(), 20.0 * np.log10(np.abs(loop.curve.value)), atol=1e-9)
    for name in ("nyquist", "nichols", "sensitivity", "poles", "step"):
        assert getattr(study, f"plot_{name}")("attitude_x").axes


def test_a_law(tmp_path):
    law = perilune.law("diveev_2013")
    assert "u1 = " in "\n".join(law.lines())
    notebook = law._repr_html_()
    assert "u1 = " in html.fromstring(notebook).text_content()
    assert len(pictures(notebook)) == 1
    law.report(tmp_path / "law.html")
    page = html.fromstring((tmp_path / "law.html").read_bytes())
    assert page.xpath("//*[local-name()='svg' and @aria-label='Graph of diveev_2013']//*[.='u2 = z16']")
    law.write_parameters(tmp_path / "law.ssv")
    assert [*perilune.validate(tmp_path / "law.ssv")] == [FileCheck(str(tmp_path / "law.ssv"), (), ())]


@pytest.mark.slow
def test_plans(tmp_path):
    plan = perilune.plan_hover_transfer()
    assert 77.0 < plan.programme.duration < 78.0  # Huang (2017): 78 s
    plan.report(tmp_path / "page.html")
    assert (tmp_path / "page.html").is_file()
    notebook = plan._repr_html_()
    assert "propellant fraction 0.049514" in html.fromstring(notebook).text_content()
    assert len(pictures(notebook)) == 1
    with pytest.raises(perilune.InputError, match="does not exceed gravity"):
        perilune.plan_hover_transfer(vehicle=perilune.Vehicle(6000.0, 0.0, 300.0, 4707.0, 313.0, 0.01))
