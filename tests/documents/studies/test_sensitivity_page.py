"""Page of a sensitivity study: indices, bars, and numbers without indices.

Truth: the shares of the variance of a sum of independent draws; lengths measured in the SVG of the page.
"""

import numpy as np
import pytest

from perilune.analysis.documents.common.colours import BLUE, SKY
from perilune.analysis.documents.of.studies.sensitivity import index_table, rank_table
from perilune.analysis.documents.of.studies.sensitivity_figures import bars_of
from tests.documents.leads import assert_lead_everywhere
from tests.support.pages.checks import assert_self_contained, data_values, parse, read_path, text_of
from tests.support.pages.studies import SHARES


@pytest.fixture(scope="module")
def page(sensitivity_result, tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "page.html"
    sensitivity_result.report(path)
    return path.read_text(encoding="utf-8")


def test_stands_alone(page):
    assert_self_contained(page)
    words = text_of(page)
    assert "Sobol' indices of 1 of 3 numbers" in words
    assert "Same: no indices, -1 in all simulations" in words
    assert "3 dispersed parameters: a.gain, b.gain, c.gain" in words


def test_the_shares_of_a_sum_lie_in_the_intervals(sensitivity_result):
    bars = bars_of(sensitivity_result, "total")
    assert [bar.name for bar in bars] == sorted(SHARES, key=lambda name: -SHARES[name])
    for bar in bars:
        assert bar.total_interval[0] < SHARES[bar.name] < bar.total_interval[1]
        assert bar.first_interval[0] < SHARES[bar.name] < bar.first_interval[1]


def test_the_table_has_the_numbers_of_the_result(sensitivity_result, page):
    values = set(data_values(page))
    for entry in sensitivity_result.of("total").values():
        for name in ("first", "total"):
            assert {repr(entry[name]), *map(repr, entry[f"{name}_interval"])} <= values
        assert repr(entry["rank"]) in values


def test_bars_are_as_long_as_the_indices(sensitivity_result, page):
    """Every bar begins at 0 and all have one scale, which is that of the first."""
    bars = bars_of(sensitivity_result, "total")
    root = parse(page)
    lengths, indices = [], []
    (figure,) = root.xpath("//*[@class='figure']")
    for order, colour in (("total", BLUE), ("first", SKY)):
        paths = figure.xpath(f".//*[local-name()='path'][@fill='{colour.lower()}']/@d")
        for bar, path in zip(bars, paths, strict=True):
            x = [points[0] for _, points in read_path(path.lower()) if points]
            lengths.append(max(x) - min(x))
            indices.append(abs(getattr(bar, order)))
    np.testing.assert_allclose(np.array(lengths) / lengths[0], np.array(indices) / indices[0], atol=2e-3)


def test_all_media_have_the_lead(sensitivity_result, tmp_path):
    assert_lead_everywhere(sensitivity_result, tmp_path)
    indices = sensitivity_result.of("total")
    for name, total, ends, first, _, rank in index_table(sensitivity_result, "total").rows:
        entry = indices[name]
        expected = [entry["total"], *entry["total_interval"], entry["first"], entry["rank"]]
        assert [each.value for each in (total, *ends, first, rank)] == expected
    for metric, *ranks in rank_table(sensitivity_result).rows:
        assert [each.value for each in ranks] == [*sensitivity_result.ranks[metric].values()]
