"""Files that pages show, kept in docs/files: a block of `file` with the path of one is its content in the site."""

from __future__ import annotations

import re
from pathlib import Path

TOP = Path(__file__).parents[2]
SHOWN = re.compile(r"^```file\n(docs/files/[\w/.]+)\n```$", re.MULTILINE)
LANGUAGES = {".py": "python", ".toml": "toml", ".ssd": "xml", ".ssv": "xml", ".xml": "xml"}


def insert_files(text: str) -> str:
    """Return a page with the content of each file in the place of its path."""
    return SHOWN.sub(lambda block: _block(TOP / block[1]), text)


def _block(path: Path) -> str:
    return f"```{LANGUAGES[path.suffix]}\n{path.read_text(encoding='utf-8')}```"
