"""Trials by group on the page of a comparison, and the batch that defines the groups.

Truth: the trials filtered here from the parquet files, for two cases.
"""

import numpy as np
import pyarrow.parquet
import scipy.stats

from perilune.analysis.campaigns.compare.side_by_side import compare
from tests.documents.of.comparison.page_tables import VARIANTS, statistics_of, table_rows
from tests.support.pages.checks import assert_self_contained, section_of
from tests.support.pages.comparison_samples import CAMPAIGN, write_sample
from tests.support.pages.written import write_comparison_page

CASES = """[draw.case]
distribution = "grid"
values = [1, 2]
[group]
by = "case"
"""


def test_groups(tmp_path):
    """A row per contender and group; truth: the trials filtered here, two cases in turn."""
    text = CAMPAIGN.replace("[draw.offset]", f"{CASES}[draw.offset]")
    write_sample(tmp_path / "out", text=text, traced=0)
    page = write_comparison_page([tmp_path / "out"], tmp_path / "page.html")
    assert_self_contained(page)
    rows = pyarrow.parquet.read_table(tmp_path / "out" / "trials").to_pylist()
    rates, metrics = [], []
    for name in ("success", "metric.pinpoint"):
        for variant in VARIANTS:
            for case in (1.0, 2.0):
                actual = [row[name] for row in rows if (row["variant"], row["draw.case"]) == (variant, case)]
                interval = scipy.stats.binomtest(int(sum(actual)), 20).proportion_ci(method="exact")
                rates.append([sum(actual) / 20, interval.low, interval.high, sum(actual), 20])
    for good_only in (True, False):
        for metric in ("miss", "propellant", "tilt", "x_error_over_sigma"):
            for variant in VARIANTS:
                for case in (1.0, 2.0):
                    mine = [row for row in rows if (row["variant"], row["draw.case"]) == (variant, case)]
                    retained = [row[f"metric.{metric}"] for row in mine if row["success"] or not good_only]
                    metrics.append(statistics_of(np.array(retained)))
    tree = section_of(page, "By case")
    np.testing.assert_allclose(table_rows(tree, 5), rates, rtol=1e-9)
    np.testing.assert_allclose(table_rows(tree, 10), metrics, rtol=1e-12)
    actual = compare([tmp_path / "out"])
    assert actual.content()["group"] == "case"
    assert actual.summary["beta"].groups["2"].rates["success"].trials == 20
    assert [line.split()[:3] for line in actual.text().splitlines()[1:4]] == [
        ["alpha", "all", "40"], ["alpha", "1", "20"], ["alpha", "2", "20"],
    ]  # fmt: skip


def test_a_batch_that_says_how_to_group_is_enough(tmp_path):
    """The same draws, grouped in the second folder's campaign only, or differently."""
    plain = CASES.split("[group]")[0]
    for name, head in (("plain", plain), ("grouped", CASES), ("other", CASES.replace('by = "case"', 'by = "sort"'))):
        head += '[derive]\nsort = "3 - case"\n'
        write_sample(tmp_path / name, text=CAMPAIGN.replace("[draw.offset]", f"{head}[draw.offset]"), traced=0)
    actual = compare([tmp_path / "plain", tmp_path / "grouped"])
    assert (actual.group, actual.notes) == ("case", ())
    assert list(actual.summary["plain: beta"].groups) == ["1", "2"]
    notes = compare([tmp_path / "grouped", tmp_path / "other"]).notes
    assert notes == ("grouped and other group trials by different values: case and sort",)
    assert not compare([tmp_path / "plain"]).summary["beta"].groups
