"""Selected trials as a file. Truth: the table of the folder, filtered by pyarrow."""

from __future__ import annotations

import io

import numpy as np
import pyarrow
import pyarrow.csv
import pyarrow.dataset
from pyarrow.compute import field

from perilune.analysis.show.scale import make_scale


def test_the_file_has_the_rows_of_a_selection_with_all_digits(client, campaign_folder):
    table = pyarrow.dataset.dataset(campaign_folder / "trials").to_table()
    edges = make_scale(table["metric.m0"].to_numpy()).edges
    (number,) = client.numbers("metric.m0")
    answer = client.query(
        "selected.csv", ranges=[{"column": number, "first": 1000, "last": 3000}], outcome="success", variants=[0, 2]
    )
    assert answer.headers["content-type"].startswith("text/csv")
    assert "attachment" in answer.headers["content-disposition"]
    actual = pyarrow.csv.read_csv(io.BytesIO(answer.content))
    variants = pyarrow.array([client.campaign.variants[each] for each in (0, 2)])
    within = (field("metric.m0") >= edges[1000]) & (field("metric.m0") < edges[3001])
    expected = table.filter(within & field("success") & field("variant").isin(variants))
    assert actual.num_rows == expected.num_rows > 10
    assert set(client.names) <= set(actual.column_names)
    order = [("variant", "ascending"), ("trial", "ascending")]
    actual, expected = actual.sort_by(order), expected.sort_by(order)
    for name in actual.column_names:
        mine, truth = actual[name].to_pylist(), expected[name].to_pylist()
        if name in client.names:
            np.testing.assert_array_equal(np.array(mine, float), np.array(truth, float))
        else:
            assert mine == truth


def test_nothing_selected_is_an_empty_file(client):
    assert client.query("selected.csv", variants=[]).content == b""
