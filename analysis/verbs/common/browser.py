"""Access to the user's browser."""

from __future__ import annotations

import webbrowser
from pathlib import Path

from ....common.errors import InputError

REMEDY = "open the file in another way"


def require_browser(option: str) -> None:
    """Reject ``option`` if no browser is installed. Raises InputError."""
    try:
        webbrowser.get()
    except webbrowser.Error as error:
        raise InputError(option, "", "no browser is installed here", f"leave out {option}, and {REMEDY}") from error


def open_page(option: str, page: Path) -> None:
    """Open a page in the browser. Raises InputError if that fails."""
    if not webbrowser.open(page.absolute().as_uri()):
        raise InputError(option, str(page), "no browser could open the page", REMEDY)
