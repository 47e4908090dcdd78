"""Numbers of the tables of a page, and the statistics that they have."""

import math

import numpy as np

VARIANTS = ("alpha", "beta", "gamma")


def numbers(element):
    """Return the exact numbers of an element."""
    return [float(value) for value in element.xpath(".//data/@value")]


def table_rows(element, columns):
    """Return the exact numbers of those rows of a section's tables that have ``columns``."""
    actual = [numbers(row) for row in element.xpath(".//tbody/tr")]
    return [row for row in actual if len(row) == columns]


def statistics_of(values):
    """Return the statistics of a metric in the order of its row."""
    quantiles = np.quantile(values, [0.05, 0.5, 0.95, 0.99], method="inverted_cdf")
    rms = math.sqrt(np.mean(values**2))
    return [values.mean(), values.std(ddof=1), rms, values.min(), *quantiles, values.max(), len(values)]
