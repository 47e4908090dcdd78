"""Page of a batch. Truth: hand-written outcomes."""

import math
import re

import numpy as np
import pytest

from perilune.analysis.campaigns.statistics import STATISTICS
from perilune.analysis.documents.of.batch.scatters import failure_figures, influence_on_success
from perilune.analysis.documents.render.html import panel_of
from tests.support.pages.checks import assert_self_contained, data_values, parse, section_of, text_of
from tests.support.pages.samples import (
    DIGEST,
    DRAWS,
    METRICS,
    batch_result,
    grouped_batch,
    mixed_batch,
    write_batch_page,
)


def write(result, path):
    write_batch_page(result, path)
    return path.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def result():
    return mixed_batch()


@pytest.fixture(scope="module")
def page(result, tmp_path_factory):
    return write(result, tmp_path_factory.mktemp("batch") / "batch.html")


def test_stands_alone(page):
    assert_self_contained(page)


def test_same_result_same_bytes(page, tmp_path):
    assert write(mixed_batch(), tmp_path / "again.html") == page


def test_every_number_of_the_summary_is_there(result, page):
    values = set(data_values(page))
    for variant in result.summary.values():
        for number in (variant.success_rate, *variant.success_interval, *variant.statuses.values()):
            assert repr(number) in values
        for table in (variant.metrics, variant.metrics_all):
            for actual in table.values():
                assert {repr(actual.count), *(repr(actual.value(column)) for column in STATISTICS)} <= values


def test_every_name_is_there(result, page):
    text = text_of(page)
    for name in ("steady", "shaky", "miss", "tilt", "offset", "ship.mass", "twice", "how far off", "test.toml", DIGEST):
        assert name in text
    assert result.plan.campaign.success.text in text
    assert "stop_time (ship.status 2)" in text


def test_requirements_have_verdicts_in_words_and_colour(tmp_path):
    """Truth: the summary; a requirement that every trial keeps, one that too few show, one that too many fail."""
    text = "".join(
        f'[requirement.{name}]\nexpression = "{expression}"\nshare = {fraction}\nconfidence = "90 %"\n{more}'
        for name, expression, fraction, more in (
            ("easy", "tilt < 1e9", 0.5, 'description = "one can do it"\n'),
            ("strict", "tilt < 1e9", 0.9987, 'metric = "tilt"\nbound = "upper"\n'),
            ("steep", "tilt > 1e9", 0.5, 'metric = "tilt"\nbound = "lower"\n'),
        )
    )
    page = write(mixed_batch(text=DRAWS + METRICS + text), tmp_path / "page.html")
    assert_self_contained(page)
    section = section_of(page, "Requirements")
    cells = section.xpath(".//td[contains(@class, 'verdict')]")
    words = [("met", "verdict pass"), ("undecided", "verdict not-applicable"), ("not met", "verdict fail")]
    assert [(cell.text, cell.get("class")) for cell in cells] == [pair for pair in words for _ in range(2)]
    displayed = text_of(page)
    assert "1731, 2951, 4053" in displayed
    assert (
        "no upper bound of tilt with 99.87 % probability at 90 % confidence: 1731 more trials are needed for a bound"
        in displayed
    )
    assert "tilt >= 5.73 deg with 50 % probability at 90 % confidence: 16th worst of 40" in displayed  # 0.1 rad
    assert "one can do it" in displayed
    without = write(mixed_batch(), tmp_path / "without.html")
    assert "Requirements" not in [heading.text for heading in parse(without).xpath("//h2")]
    assert ("Not judged: no requirements declared" in text_of(without), "Not judged" in displayed) == (True, False)


def test_every_group_has_rows_of_its_own(tmp_path):
    """Truth: the trials of each case, filtered here."""
    result = grouped_batch()
    page = write(result, tmp_path / "page.html")
    assert_self_contained(page)
    section = section_of(page, "By case")
    rates, good, everything = (
        [[float(value) for value in row.xpath(".//data/@value")] for row in table.xpath(".//tbody/tr[td]")]
        for table in section.xpath(".//table")
    )
    case = result.plan.draws.columns["case"]
    places = [(variant, np.flatnonzero(case == k)) for variant in ("steady", "shaky") for k in (0.5, 1.0, 2.0)]
    assert [row[:2] for row in rates] == [[len(at), result.trials[name].success[at].mean()] for name, at in places]
    for rows, metric, chosen in (
        (good[:6], "miss", lambda trials: trials.success),
        (everything[6:], "tilt", lambda trials: np.full(trials.success.size, True)),
    ):
        for row, (name, at) in zip(rows, places, strict=True):
            trials = result.trials[name]
            values = trials.metrics[metric][at][chosen(trials)[at]]
            quantiles = [np.sort(values)[math.ceil(percent * values.size / 100) - 1] for percent in (5, 50, 95, 99)]
            expected = [values.mean(), values.std(ddof=1), math.sqrt(np.mean(values**2)), values.min(), *quantiles]
            assert row == pytest.approx([*expected, values.max(), values.size], rel=1e-12)
    cells = [row.xpath("td")[1].text for row in section.xpath(".//table")[0].xpath(".//tbody/tr")]
    assert cells == ["0.5", "1", "2"] * 2


def test_without_groups_there_is_no_such_section(page):
    assert not [part for part in parse(page).xpath("//h2") if part.text.startswith("By ")]


def test_infinite_quantiles_are_shown(tmp_path):
    rows = [(True, float(k), math.inf if k > 17 else 0.1) for k in range(20)]
    page = write(batch_result({"late": rows}, DRAWS + METRICS), tmp_path / "page.html")
    assert page.count('<data value="inf">∞</data>') == 4  # 95 and 99 %, of the successful and of all trials


def test_angles_are_in_degrees_on_screen(result, page):
    mean = result.summary["shaky"].metrics["tilt"].mean
    assert f">{math.degrees(mean):.4g}</data>" in page
    assert "tilt, deg" in text_of(page)


def test_units_of_dispersed_parameters_are_stated(page):
    """They are those of the campaign, while metrics are in degrees."""
    text = text_of(page)
    assert "As the campaign declares them, in SI units." in text
    assert "Angles of metrics are displayed in degrees." in text


def test_what_only_scripts_can_do_is_promised_only_with_them(page):
    (promise,) = parse(page).xpath("//p[contains(., 'a click pins it')]/..")
    assert {"screen", "answers"} <= set(promise.get("class").split())
    assert re.search(r"@media not \(scripting: enabled\) {\s*\.answers { display: none; }", page)


def test_failures_at_both_ends_are_told_by_the_draw_that_causes_them(result):
    scores = influence_on_success(result, "shaky")
    assert next(iter(scores)) == "offset"
    assert set(scores) == {"offset", "ship.mass"}  # what is derived does not count
    assert 0.6 < scores["offset"] <= 1.0
    assert influence_on_success(result, "steady") == {}


def test_scatter_counts_its_points(result):
    failed = sum(not good for good in result.trials["shaky"].success)
    (panel,) = map(panel_of, failure_figures(result))
    assert panel.label == f"shaky: {failed} of 40 failed"
    assert panel.figure.svg.count("h0") == 40 - failed  # a dot is a stroke without length


def test_no_failures(tmp_path):
    text = text_of(write(batch_result({"only": [(True, 0.5, 0.1)] * 5}), tmp_path / "page.html"))
    assert "No failures: only." in text
    assert "miss is 0.5 m in every trial of every variant" in text
    assert "tilt is 5.73 deg in every trial" in text


def test_nothing_finite(tmp_path):
    page = write(batch_result({"only": [(False, math.nan, math.inf)] * 5}), tmp_path / "page.html")
    assert_self_contained(page)
    assert "miss has no finite value in any trial" in text_of(page)
    assert "All trials failed, so no influence can be computed: only." in text_of(page)


def test_one_trial(tmp_path):
    page = write(batch_result({"only": [(True, 0.5, 0.1)]}), tmp_path / "page.html")
    assert_self_contained(page)
    assert all(f'aria-label="Cumulative distribution of {name}"' in page for name in ("miss", "tilt"))
    assert "2.50 to 100.00" in text_of(page)


@pytest.mark.parametrize("good", [[True] * 4, [True, False, True, False]])
def test_no_draws(good, tmp_path):
    result = batch_result({"default": [(ok, 1.0, k / 7) for k, ok in enumerate(good)]}, METRICS)
    text = text_of(write(result, tmp_path / "page.html"))
    assert "all trials have the same parameters" in text
    assert ("there is no failure region" in text) == (not all(good))


def test_no_metrics(tmp_path):
    result = batch_result({"default": [(True, 0.0, 0.0)] * 3}, '[success]\nexpression = "1"\n')
    assert "The campaign declares no metrics" in text_of(write(result, tmp_path / "page.html"))


def test_one_draw(tmp_path):
    text = '[draw.offset]\ndistribution = "uniform"\nlow = 0\nhigh = 1\n' + METRICS
    result = batch_result({"v": [(k % 3 > 0, float(k), -float(k)) for k in range(12)]}, text)
    assert_self_contained(write(result, tmp_path / "page.html"))


def test_many_trials_stay_small(tmp_path):
    source = np.random.default_rng(1)
    rows = [(bool(source.random() < 0.7), float(source.lognormal(0, 3)), float(source.normal())) for _ in range(10_000)]
    page = write(batch_result({"many": rows}), tmp_path / "page.html")
    assert_self_contained(page)
    assert len(page) < 1_000_000
