"""perilune.plot_results: the same metrics of several campaigns in one figure.

Truth: the empirical distributions of the batches in memory; the rule that metrics of different units are refused.
"""

import numpy as np
import pytest

import perilune
from perilune.analysis.verbs.batch import BatchResult
from tests.support.pages.comparison_samples import CAMPAIGN, sample_batch, write_sample


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """Write two campaigns with other draws, numbers of trials and variants."""
    base = tmp_path_factory.mktemp("plots")
    write_sample(base / "one", trials=30, variants=("alpha", "beta"))
    write_sample(base / "two", trials=50, variants=("alpha",), seed=9, noise=2.0)
    return {"one": base / "one", "two": base / "two"}


def names(figure):
    return [text.get_text() for text in figure.legends[0].get_texts()]


def test_lines_are_empirical_distributions(folders):
    figure = perilune.plot_results(folders, ["miss"])
    assert names(figure) == ["one: alpha", "one: beta", "two"]
    one = sample_batch(trials=30, variants=("alpha", "beta"))
    two = sample_batch(trials=50, variants=("alpha",), seed=9, noise=2.0)
    columns = [one.trials["alpha"], one.trials["beta"], two.trials["alpha"]]
    (panel,) = figure.axes
    for line, trials in zip(panel.lines, columns, strict=True):
        values = np.sort(trials.metrics["miss"])
        sampled = line.get_xdata()[1:-1]
        np.testing.assert_array_equal(sampled, np.clip(values, sampled[0], None))
        np.testing.assert_allclose(line.get_ydata()[1:-1], 100.0 * np.arange(1, values.size + 1) / values.size)
    assert panel.get_xlabel() == "miss, m"


def test_folders_and_what_was_opened_or_flown_are_alike(folders):
    created = sample_batch(trials=50, variants=("alpha",), seed=9, noise=2.0)
    flown = BatchResult(created.plan, created.rows, created.provenance)
    settings = {"one": perilune.open_results(folders["one"]), "two": flown}
    lines = [
        [line.get_xydata() for axes in perilune.plot_results(results).axes for line in axes.lines]
        for results in (folders, settings)
    ]
    assert len(lines[0]) == 3 * 5
    for first, second in zip(*lines, strict=True):
        np.testing.assert_array_equal(first, second)


def test_one_campaign_by_itself(folders):
    figure = perilune.open_results(folders["one"]).plot("miss", "tilt")
    assert names(figure) == ["alpha", "beta"]
    assert [axes.get_xlabel() for axes in figure.axes] == ["miss, m", "tilt, deg"]


def test_only_what_all_campaigns_have_is_drawn_unasked(folders, tmp_path):
    lacking = CAMPAIGN.partition("[metric.propellant]")
    write_sample(tmp_path, text=f"{lacking[0]}[metric.tilt]{lacking[2].partition('[metric.tilt]')[2]}")
    figure = perilune.plot_results({**folders, "lacking": tmp_path})
    assert [axes.get_xlabel().partition(",")[0] for axes in figure.axes] == [
        "miss", "tilt", "pinpoint", "x_error_over_sigma",
    ]  # fmt: skip


def test_units_that_differ_are_refused(folders, tmp_path):
    write_sample(tmp_path, text=CAMPAIGN.replace('unit = "kg"', 'unit = "g"'))
    with pytest.raises(perilune.InputError) as caught:
        perilune.plot_results({"one": folders["one"], "grams": tmp_path})
    assert str(caught.value).startswith("grams: metric propellant: its unit is g, but kg in one;")
    assert perilune.plot_results({"one": folders["one"], "grams": tmp_path}, ["miss"]).axes


def test_what_there_is_not_to_draw(folders):
    with pytest.raises(KeyError, match="no metric mis in one; use one of miss"):
        perilune.plot_results(folders, ["mis"])
    with pytest.raises(KeyError, match="no metric mis; use one of miss"):
        perilune.open_results(folders["one"]).plot("mis")
    with pytest.raises(perilune.InputError, match="no results; give folders"):
        perilune.plot_results({})
