"""Tables on the page of a comparison: verdicts, rates, metrics, ends, errors over sigma.

Truth: the same numbers computed here with numpy and scipy from the parquet files.
"""

import math

import numpy as np
import pytest
import scipy.stats

from tests.documents.of.comparison.page_tables import VARIANTS, numbers, statistics_of, table_rows
from tests.support.pages.checks import parse, section_of, text_of
from tests.support.pages.comparison_samples import POSITION, TARGET, VELOCITY, write_sample
from tests.support.pages.written import write_comparison_page


def test_rates_and_their_intervals(page, trials):
    expected = []
    for name in ("success", "metric.pinpoint"):
        for variant in VARIANTS:
            yes = int(trials[variant][name].sum())
            low = scipy.stats.beta.ppf(0.025, yes, 40 - yes + 1)
            high = scipy.stats.beta.ppf(0.975, yes + 1, 40 - yes) if yes < 40 else 1.0
            expected.append([yes / 40, low, high, yes, 40])
    np.testing.assert_allclose(table_rows(section_of(page, "Success probabilities"), 5), expected, rtol=1e-9)


def test_the_first_table_has_a_row_per_variant(page, trials):
    """Success with its interval, and the metric of success over all trials, with the worst trial against its limit."""
    expected = []
    for variant in VARIANTS:
        success, miss = trials[variant]["success"], trials[variant]["metric.miss"]
        interval = scipy.stats.binomtest(int(success.sum()), 40).proportion_ci(method="exact")
        median = np.quantile(miss, 0.5, method="inverted_cdf")
        expected.append([success.mean(), interval.low, interval.high, 40, median, miss.max(), np.argmax(miss)])
    (table,) = parse(page).xpath("//table[contains(@class, 'verdicts')]")
    rows = table.xpath("tbody/tr")
    np.testing.assert_allclose([numbers(row) for row in rows], expected, rtol=1e-9)
    assert "at most 3" in table.xpath("thead")[0].text_content()
    best = [row.xpath("td[2]/b") != [] for row in rows]
    assert best == [row[0] == max(each[0] for each in expected) for row in expected]


def test_metrics_of_the_successful_and_of_all_trials(page, trials):
    expected = []
    for chosen in (lambda actual: actual["success"], lambda actual: np.full(40, True)):
        for metric in ("miss", "propellant", "tilt", "x_error_over_sigma"):
            for variant in VARIANTS:
                values = trials[variant][f"metric.{metric}"][chosen(trials[variant])]
                expected.append(statistics_of(values))
    np.testing.assert_allclose(
        table_rows(section_of(page, "Metrics of the successful trials"), 10), expected, rtol=1e-12
    )
    tilt = trials["beta"]["metric.tilt"][trials["beta"]["success"]].mean()
    assert f">{math.degrees(tilt):.4g}</data>" in page


def test_a_quantile_printed_twice_is_one_number(tmp_path):
    """Misses without a vertical component: the metric's table and that of the ends have the same numbers."""
    write_sample(tmp_path / "out", flat=True)
    page = write_comparison_page([tmp_path / "out"], tmp_path / "page.html")
    metric = table_rows(section_of(page, "Metrics of the successful trials"), 10)[:3]
    ends = table_rows(section_of(page, "Ends of each variant"), 12)[:3]
    for row, end in zip(metric, ends, strict=True):
        median, most_of, largest = row[5], row[7], row[8]
        assert end[-3:] == pytest.approx([median, most_of, largest], rel=1e-12)


def test_dispersions_at_the_end(page, trials):
    expected = []
    for names, target in ((POSITION, TARGET), (VELOCITY, np.zeros(3))):
        for variant in VARIANTS:
            actual = trials[variant]
            errors = np.stack([actual[f"final.{name}"] for name in names], axis=1)[actual["success"]] - target
            miss = np.linalg.norm(errors[:, :2], axis=1)
            # semi-axes of the 1-sigma ellipse are singular values of the centred points over sqrt(n - 1)
            centred = errors[:, :2] - errors[:, :2].mean(axis=0)
            axes = np.linalg.svd(centred, compute_uv=False) / math.sqrt(len(errors) - 1)
            radii = [*np.percentile(miss, [50, 99], method="inverted_cdf"), miss.max()]
            expected.append([len(errors), *errors.mean(axis=0), *errors.std(axis=0, ddof=1), *axes, *radii])
    np.testing.assert_allclose(table_rows(section_of(page, "Ends of each variant"), 12), expected, rtol=1e-9)
    assert "ellipses contain 39.3, 86.5 and 98.9 %" in text_of(page)  # test_comparison_figures.py: they do


def test_errors_over_sigma(page, trials):
    expected = []
    for variant in VARIANTS:
        values = trials[variant]["metric.x_error_over_sigma"]
        fractions = []
        for limit in (1, 2, 3):
            inside = int(np.sum(np.abs(values) <= limit))
            interval = scipy.stats.binomtest(inside, 40).proportion_ci(method="exact")
            fractions += [inside / 40, interval.low, interval.high]
        expected.append([values.mean(), values.std(ddof=1), *fractions, 40])
    actual = table_rows(section_of(page, "Normalised estimation errors"), 12)
    np.testing.assert_allclose(actual, expected, rtol=1e-9)
    assert "normal: 68.3" in text_of(page)
