"""Page of a block: all declarations of its class, and the required sections of its docstring.

Truth: the model description built from the same class and read by FMPy; the classes.
"""

from __future__ import annotations

import inspect
import re

import pytest
from fmpy import read_model_description

from docs.reference.blocks import block_page, fitting, slots_of
from docs.reference.unread import find_unread
from docs.reference.usage import usages
from perilune.common.paths import ROOT, shipped_fmu
from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.runtime import BlockInstance
from tests.support.lengths import either

# Blocks that count, compare or pass on, without a model of anything that could be left out.
WITHOUT_MODEL = {
    "air_disturbance",
    "command_switch",
    "estimate_monitor",
    "flight_monitor",
    "ideal_navigation",
    "jet_health",
    "landing_sequencer",
    "rendezvous_monitor",
    "touchdown_monitor",
}
SAMPLED = [*catalogue()][:: either(1, 5)]
ASSUMPTION = re.compile(r"\b[Aa]ssumes\b")
SOURCE = re.compile(r"\bSources?\b[^:]*: |docs/[\w/]+\.md")


def words_of(block: type[Block]) -> str:
    """Return the docstrings of a block and of its bases."""
    bases = [base for base in block.__mro__ if issubclass(base, Block) and base is not Block]
    return "\n".join(inspect.cleandoc(base.__doc__ or "") for base in bases)


@pytest.mark.parametrize("name", catalogue())
def test_a_docstring_has_purpose_assumptions_and_source(name):
    block = catalogue()[name]
    assert re.search(r"[.:]$", block.summary()), "the first line is the purpose, a sentence"
    words = words_of(block)
    assert SOURCE.search(words), "say where the law or model is from, or which page of docs has it"
    assert name in WITHOUT_MODEL or ASSUMPTION.search(words), "say what the model or the law assumes"
    for page in re.findall(r"docs/[\w/]+\.md", words):
        assert (ROOT / page).is_file(), page


@pytest.mark.parametrize("name", SAMPLED)
def test_the_page_has_every_variable(name):
    """Each variable of modelDescription.xml has its row, with type, unit and description."""
    page = block_page(catalogue()[name])
    rows = {
        re.split(r"[\[`]", row.split("`")[1])[0]: row.replace("\\", "").replace("&lt;", "<")
        for row in page.splitlines()
        if row.startswith("| `")
    }
    description = read_model_description(str(shipped_fmu(name, "python")), validate=False)
    seen = set()
    for variable in description.modelVariables:
        if variable.causality == "independent":
            continue
        whole = variable.name.partition("[")[0]
        seen.add(whole)
        assert f"| {variable.type} |" in rows[whole]
        if variable.unit is not None:
            assert f"| {variable.unit} |" in rows[whole]
        if variable.min is not None:
            assert f"{float(variable.min):g}" in rows[whole]
        if variable.causality == "parameter":
            assert ("| tunable |" in rows[whole]) == (variable.variability == "tunable")
            assert ("| fixed: " in rows[whole]) == (variable.variability == "fixed")
    assert {name.partition(".")[0] for name in seen} == set(catalogue()[name].variables)


def source_text(block: type[Block]) -> str:
    """Return the text of a block's class and of all that it is derived from."""
    return "\n".join(inspect.getsource(base) for base in block.__mro__ if issubclass(base, Block) and base is not Block)


@pytest.mark.parametrize("name", SAMPLED)
def test_what_a_block_never_reads_another_one_does(name, monkeypatch):
    """The page says which; the block runs its check without looking at it, and the readers' text has it."""
    block = catalogue()[name]
    unread = find_unread(block)
    page = block_page(block)
    assert ("It never reads" in page) == bool(unread)
    for each in unread:
        assert name not in each.readers
        assert each.declared_in is not block
        assert each.readers, f"no block reads {each.name}: delete it"
        for reader in each.readers:
            assert f"self.{each.name}" in source_text(catalogue()[reader])
            assert f"[{reader}]({reader}.md)" in page.partition("It never reads")[2]
    if not unread or block.python_only:
        return
    component = BlockInstance(block)
    component.start()
    accessed = set()

    def note(self, attribute):
        accessed.add(attribute)
        return object.__getattribute__(self, attribute)

    monkeypatch.setattr(type(component.block), "__getattribute__", note, raising=False)
    component.block.initialize()
    for step in range(3):
        component.block.step(step * block.default_step, block.default_step)
    assert accessed
    assert not accessed & {each.name for each in unread}


@pytest.mark.usefixtures("fmus")
def test_systems_that_use_a_block_name_it():
    """As text searches of the systems' own files find them."""
    for name, usage in usages().items():
        for system in usage.components:
            assert f'"{name}"' in (ROOT / "ssp_systems" / system / "system.toml").read_text(encoding="utf-8")
        for system, campaigns in usage.campaigns.items():
            for campaign in campaigns:
                folder = ROOT / "ssp_systems" / system / "campaigns"
                files = [folder / f"{campaign}.toml", folder / "paper.toml", *(folder / "parts").glob("*.toml")]
                assert any(f'"{name}"' in file.read_text(encoding="utf-8") for file in files if file.is_file())
    assert len(usages()) > 50


def test_what_fits_has_all_connectors():
    assert "astar_guidance" in fitting(catalogue()["analytic_guidance"])
    for block in catalogue().values():
        for slot in slots_of(block):
            assert issubclass(block, slot)
        for name in fitting(block):
            other = catalogue()[name].variables
            for variable in block.variables.values():
                if variable.causality in ("input", "output"):
                    assert other[variable.name].causality == variable.causality
                    assert other[variable.name].size >= variable.size
