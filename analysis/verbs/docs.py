"""`perilune docs`: the documentation, opened in a browser."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Unpack

from ...common.errors import InputError
from ...common.paths import BUILD, IS_CHECKOUT
from ..documents.model import Document
from ..documents.of.written_files import site_document
from ..options.declared.library import DOCS, DocsOptions
from ..options.verb import verb
from .common.browser import open_page
from .common.documented import Documented

FIRST_PAGE = BUILD / "site" / "index.html"


@dataclass(frozen=True)
class Documentation(Documented):
    """The first ``page`` of the documentation, and True if a browser opened it."""

    page: Path
    is_opened: bool

    def document(self) -> Document:
        """Return a document with the path of the page."""
        return site_document(self.page, self.is_opened)


@verb(DOCS)
def docs(**options: Unpack[DocsOptions]) -> Documentation:
    """Open the documentation in a browser, or with ``print`` return its path: `perilune docs`. Raises InputError."""
    if not FIRST_PAGE.is_file():
        remedy = "build it with make docs" if IS_CHECKOUT else "read docs/ of the repository, or reinstall perilune"
        raise InputError("docs", str(FIRST_PAGE), "the documentation is not built", remedy)
    if options["print"]:
        return Documentation(FIRST_PAGE, False)
    open_page("docs", FIRST_PAGE)
    return Documentation(FIRST_PAGE, True)
