"""FMUs follow the rules documented by importers; the page names each checked rule.

A checkout builds libraries for its machine; the libraries of a wheel are tested in tests/package/test_wheel.py.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.reference.formats.pages import format_pages
from perilune.common.paths import shipped_fmu
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.native_fmu import build_native_fmu
from tests.support.native.building import NATIVE

from .documented_rules import RULES, WINDOWS, broken_rules

PAGE = format_pages()["importers.md"]


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("name", NATIVE)
def test_an_fmu_keeps_the_rules(name: str) -> None:
    assert set(broken_rules(shipped_fmu(name, "native"))) <= {WINDOWS}


@pytest.mark.slow  # zig builds the C library of Windows first, for a minute
@pytest.mark.parametrize("name", NATIVE)
def test_an_fmu_for_others_keeps_all_of_them(name: str, tmp_path: Path) -> None:
    pytest.importorskip("ziglang")
    path = tmp_path / f"{name}.fmu"
    build_native_fmu(catalogue()[name], path, platforms=("linux64", "win64"))
    assert broken_rules(path) == []


def test_the_page_names_every_rule() -> None:
    assert [rule.name for rule in RULES if rule.name not in PAGE] == []
