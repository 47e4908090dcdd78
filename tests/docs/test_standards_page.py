"""Numbers of docs/concepts/standards.md: connectors and connections of the shipped systems, with vectors as one.

Truth: the SSDs themselves, read as XML.
"""

import re

import pytest
from lxml import etree

from perilune.analysis.runtime.ssp.archive import system_names
from perilune.common.paths import ROOT, SYSTEMS

pytestmark = pytest.mark.usefixtures("fmus")
INDEX = re.compile(r"\[[\d,]+\]$")


def count(name):
    """Count connectors, those without indices, connections, those without indices."""
    root = etree.parse(SYSTEMS / name / "SystemStructure.ssd").getroot()
    connectors = [(each.getparent().getparent().get("name"), each.get("name")) for each in root.iter("{*}Connector")]
    ends = ("startElement", "startConnector", "endElement", "endConnector")
    connections = [tuple(each.get(end) or "" for end in ends) for each in root.iter("{*}Connection")]
    return [
        number
        for rows in (connectors, connections)
        for number in (len(rows), len({tuple(INDEX.sub("", name) for name in row) for row in rows}))
    ]


def test_counts():
    counts = {name: count(name) for name in system_names()}
    page = (ROOT / "docs" / "concepts" / "standards.md").read_text(encoding="utf-8")
    rows = {"all eleven": [sum(column) for column in zip(*counts.values(), strict=True)]}
    rows |= {f"`{name}`": counts[name] for name in counts if f"| `{name}` |" in page}
    assert len(counts) == 11
    assert len(rows) > 3
    for label, (first, second, third, fourth) in rows.items():
        assert f"| {label} | {first}, {second} | {third}, {fourth} |" in page
