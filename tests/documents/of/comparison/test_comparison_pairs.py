"""Pairs of variants on the page of a comparison: sentences on differences, tables of rates and metrics.

Truth: the same numbers computed here with numpy and scipy from the parquet files.
"""

import numpy as np
import scipy.stats

from tests.documents.of.comparison.page_tables import numbers
from tests.support.pages.checks import parse, section_of


def test_a_sentence_for_each_pair_that_differs(page, trials):
    """Truth: McNemar's and the sign test by the binomial distribution, the k-th smallest at 5 % / (n - k)."""
    tests = []
    for a, b in (("beta", "alpha"), ("gamma", "alpha"), ("gamma", "beta")):
        x, y = (trials[variant]["success"].astype(bool) for variant in (a, b))
        tests.append((scipy.stats.binomtest(int((x & ~y).sum()), int((x != y).sum())).pvalue, a, b, "success"))
        both = x & y
        less = trials[a]["metric.miss"][both] < trials[b]["metric.miss"][both]
        tests.append((scipy.stats.binomtest(int(less.sum()), int(both.sum())).pvalue, a, b, "miss"))
    expected = {}
    for rank, (p, a, b, name) in enumerate(sorted(tests)):
        if p > 0.05 / (len(tests) - rank):
            break
        expected.setdefault((a, b), set()).add(name)
    actual = {}
    for line in parse(page).xpath("//ul[@class='differences']/li"):
        pair = tuple(each.text_content().strip() for each in line.xpath("span[@class='who']"))
        actual[pair] = {name for name in ("success", "miss") if f"{name} " in line.text_content()}
    assert actual == expected
    assert expected


def test_pairs_of_rates(page, trials):
    rows = []
    for against_reference in (True, False):
        for name in ("success", "metric.pinpoint"):
            for a, b in (("beta", "alpha"), ("gamma", "alpha"), ("gamma", "beta")):
                if (b == "alpha") == against_reference:
                    x, y = (trials[variant][name].astype(bool) for variant in (a, b))
                    table = [[np.sum(x & y), np.sum(x & ~y)], [np.sum(~x & y), np.sum(~x & ~y)]]
                    discordant = table[0][1] + table[1][0]
                    p = scipy.stats.binomtest(int(table[0][1]), int(discordant)).pvalue
                    rows.append([x.mean() - y.mean(), p, table[0][0], table[0][1], table[1][0], table[1][1]])
    tree = section_of(page, "Paired comparison")
    first, others = tree.xpath(".//table")[:2]  # against the reference, and what is folded away
    actual = [numbers(row) for table in (first, others) for row in table.xpath(".//tr") if numbers(row)]
    np.testing.assert_allclose([[row[0], *row[3:]] for row in actual], rows, rtol=1e-9, atol=1e-12)
    assert all(row[1] < row[0] < row[2] for row in actual)


def test_pairs_of_metrics(page, trials):
    tree = section_of(page, "Paired comparison")
    (heading,) = (part for part in tree.xpath(".//h3") if part.text == "Metrics, trials in which both succeed")
    table = heading.getnext().xpath(".//table")[0]
    expected = []
    for metric in ("miss", "propellant", "tilt"):
        for variant in ("beta", "gamma"):
            both = trials[variant]["success"] & trials["alpha"]["success"]
            x, y = (trials[name][f"metric.{metric}"][both] for name in (variant, "alpha"))
            interval = scipy.stats.quantile_test(x - y, p=0.5).confidence_interval(0.95)
            smaller = int(np.sum(x < y))
            p = scipy.stats.binomtest(smaller, int(both.sum())).pvalue
            fractions = [smaller / both.sum(), 0, np.mean(x > y), both.sum()]
            expected.append(
                [np.quantile(x - y, 0.5, method="inverted_cdf"), interval.low, interval.high, p, *fractions]
            )
    actual = [numbers(row) for row in table.xpath(".//tr") if len(numbers(row)) == 8]
    np.testing.assert_allclose(actual, expected, rtol=1e-9)


def test_intervals_without_zero_are_bold_and_others_are_not(page):
    actual = []
    for cell in section_of(page, "Paired comparison").xpath(".//td[contains(@class, 'n')]"):
        ends = numbers(cell)
        if len(ends) == 2:
            actual.append(ends[0] > 0.0 or ends[1] < 0.0)
            assert (cell.find("b") is not None) == actual[-1]
    assert set(actual) == {True, False}
