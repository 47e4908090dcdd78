"""A batch of three variants, the page that compares them, and its trials."""

import numpy as np
import pyarrow.parquet
import pytest

from tests.documents.of.comparison.page_tables import VARIANTS


@pytest.fixture(scope="module")
def folder(comparison):
    return comparison / "quiet"


@pytest.fixture(scope="module")
def page(comparison):
    return (comparison / "page.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def trials(folder):
    """Columns of trials/ by variant."""
    rows = pyarrow.parquet.read_table(folder / "trials").to_pylist()
    return {
        variant: {name: np.array([row[name] for row in rows if row["variant"] == variant]) for name in rows[0]}
        for variant in VARIANTS
    }
