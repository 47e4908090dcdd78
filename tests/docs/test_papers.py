"""The pages of the papers: each row has a status and what proves it, and numbers stand where they are quoted from.

Truth: the files of the repository, the commands that other tests carry out, the linked pages.
"""

import re
from pathlib import Path

import pytest

from perilune.fmus_src.paths import ROOT
from tests.support.documented import documented

HEADER = "| Where | What | Status | Here |"
STATUSES = ("reproduced", "corrected", "chosen here", "left out")
PAGES = sorted((ROOT / "docs" / "papers").glob("*.md"))
CODE = re.compile(r"`([^`]+)`")
LINK = re.compile(r"\[([^\]]+)\]\(([^)]*)\)")
FORMULA = re.compile(r"\$[^$]+\$")
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?![\w.]*\w)")
ROWS = [
    pytest.param(page, [cell.strip() for cell in line.strip().strip("|").split(" | ")], id=f"{page.stem} {index}")
    for page in PAGES
    for index, line in enumerate(page.read_text(encoding="utf-8").partition(HEADER)[2].partition("\n\n")[0].split("\n")[2:])
]  # fmt: skip


def test_each_paper_has_a_page():
    assert [page.stem for page in PAGES] == ["diveev", "fomichev_li", "somov"]


@pytest.mark.parametrize(("page", "cells"), ROWS)
def test_a_row_has_a_status_and_what_it_rests_on(page, cells):
    assert len(cells) == 4, cells
    where, what, status, here = cells
    assert where
    assert what
    assert status in STATUSES
    assert len(here) > 10
    if status == "reproduced":
        assert CODE.search(here) or LINK.search(here), here


@pytest.mark.parametrize(("page", "cells"), ROWS)
def test_tests_and_commands_of_a_row_exist(page, cells):
    """A command is one that a page of the documentation has in a block, where other tests carry it out."""
    known = {command for commands in documented().values() for command in commands}
    for code in CODE.findall(cells[-1]):
        if code.startswith("tests/"):
            assert (ROOT / code.partition("::")[0]).exists(), code
        if code.startswith(("perilune ", "python ")):
            assert any(command.startswith(code) for command in known), code


@pytest.mark.parametrize(("page", "cells"), ROWS)
def test_numbers_of_a_row_stand_on_the_page_that_it_links(page, cells):
    """Of rows with links: numbers with a point, or of three digits, stand on one of the pages or in the paper's cell."""
    here = cells[-1]
    targets = [target.partition("#")[0] for _, target in LINK.findall(here)]
    if not targets:
        return
    quoted = " ".join(text_of(page if not name else (page.parent / name).resolve()) for name in targets) + cells[1]
    plain = FORMULA.sub("", CODE.sub("", LINK.sub(r"\1", here)))
    for number in NUMBER.findall(plain):
        if "." in number or len(number) > 2:
            assert re.search(rf"(?<![\d.]){re.escape(number)}(?![\d])", quoted), (number, here)


def text_of(path: Path) -> str:
    """The text of a page, of this one below its table of rows."""
    text = path.read_text(encoding="utf-8")
    return text.partition(HEADER)[2].partition("\n\n")[2] if HEADER in text else text
