"""Pages on the papers: each row has a status and evidence, and quoted numbers occur at their sources.

Truth: the files of the repository, the commands executed by other tests, the linked pages.
"""

import re
from pathlib import Path

import pytest

from perilune.common.paths import ROOT
from tests.support.documented import documented

HEADER = "| Where | What | Status | Here |"
STATUSES = ("reproduced", "corrected", "chosen here", "left out")
PAGES = sorted((ROOT / "docs" / "papers").glob("*.md"))
CODE = re.compile(r"`([^`]+)`")
LINK = re.compile(r"\[([^\]]+)\]\(([^)]*)\)")
FORMULA = re.compile(r"\$[^$]+\$")
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?![\w.]*\w)")


def rows_of(page: Path) -> list[list[str]]:
    """Return the entries of each row of a page's table."""
    table = page.read_text(encoding="utf-8").partition(HEADER)[2].partition("\n\n")[0]
    return [[cell.strip() for cell in line.strip().strip("|").split(" | ")] for line in table.split("\n")[2:] if line]


ROWS = [
    pytest.param(page, entries, id=f"{page.stem} {index}")
    for page in PAGES
    for index, entries in enumerate(rows_of(page))
]


def test_each_of_the_five_papers_has_a_page():
    assert [page.stem for page in PAGES] == ["diveev", "fomichev_li", "huang", "lapin", "somov"]


@pytest.mark.parametrize(("page", "entries"), ROWS)
def test_a_row_has_a_status_and_what_it_rests_on(page, entries):
    assert len(entries) == 4, entries
    where, what, status, here = entries
    assert where
    assert what
    assert status in STATUSES
    assert len(here) > 10
    if status == "reproduced":
        assert CODE.search(here) or LINK.search(here), here


@pytest.mark.parametrize(("page", "entries"), ROWS)
def test_tests_and_commands_of_a_row_exist(page, entries):
    """A command is one that a page of the documentation has in a block, where other tests carry it out."""
    known = {command for commands in documented().values() for command in commands}
    for code in CODE.findall(entries[-1]):
        if code.startswith("tests/"):
            assert (ROOT / code.partition("::")[0]).exists(), code
        if code.startswith(("perilune ", "python ")):
            assert any(command.startswith(code) for command in known), code


@pytest.mark.parametrize(("page", "entries"), ROWS)
def test_numbers_of_a_row_stand_on_the_page_that_it_links(page, entries):
    """Numbers with a point, or of three digits, stand on one of the linked pages or in the cell of the paper."""
    here = entries[-1]
    targets = [target.partition("#")[0] for _, target in LINK.findall(here)]
    if not targets:
        return
    quoted = " ".join(text_of(page if not name else (page.parent / name).resolve()) for name in targets) + entries[1]
    plain = FORMULA.sub("", CODE.sub("", LINK.sub(r"\1", here)))
    for number in NUMBER.findall(plain):
        if "." in number or len(number) > 2:
            assert re.search(rf"(?<![\d.]){re.escape(number)}(?![\d])", quoted), (number, here)


def text_of(path: Path) -> str:
    """Return the text of a page, of this one below its table of rows."""
    text = path.read_text(encoding="utf-8")
    return text.partition(HEADER)[2].partition("\n\n")[2] if HEADER in text else text
