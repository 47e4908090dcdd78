"""Page on paper, as printed by the browser."""

from __future__ import annotations

from pathlib import Path

from pypdf import PdfReader

from tests.support.lengths import either
from tests.support.pages.browser import start

FORMATS = either(("A4", "letter"), ("letter",))  # the shorter one alone where time is short


def printed(browser: str, page: Path, folder: Path, paper: str) -> PdfReader:
    """Print a page on paper of a format."""
    text = page.read_text(encoding="utf-8").replace("@page {", f"@page {{ size: {paper};")
    source, target = folder / f"{paper}.html", folder / f"{paper}.pdf"
    source.write_text(text, encoding="utf-8")
    start(browser, source, folder, "--no-pdf-header-footer", f"--print-to-pdf={target}")
    return PdfReader(target)


def words_of(sheets: PdfReader) -> str:
    """Return all text on the sheets, runs of spaces as one."""
    return " ".join(" ".join(sheet.extract_text() for sheet in sheets.pages).split())
