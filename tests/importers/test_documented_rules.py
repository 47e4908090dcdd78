"""Shipped FMUs keep the rules that importers document; the page names each rule that is checked."""

from __future__ import annotations

import pytest

from perilune.fmus_src.paths import ROOT, shipped_fmu
from tests.support.native.building import NATIVE

from .documented_rules import RULES, broken_rules

PAGE = (ROOT / "docs" / "guides" / "importers.md").read_text(encoding="utf-8")


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("name", NATIVE)
def test_an_fmu_keeps_the_rules(name: str) -> None:
    assert broken_rules(shipped_fmu(name, "native")) == []


def test_the_page_names_every_rule() -> None:
    assert [rule.name for rule in RULES if rule.name not in PAGE] == []
