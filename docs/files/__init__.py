"""Files shown on pages, kept in docs/files: a code block `file` names a path, and shows the file's content."""

from __future__ import annotations

import re
from pathlib import Path

TOP = Path(__file__).parents[2]
SHOWN = re.compile(r"^```file\n(docs/files/[\w/.]+)\n```$", re.MULTILINE)
LANGUAGES = {".py": "python", ".toml": "toml", ".ssd": "xml", ".ssv": "xml", ".xml": "xml"}


def insert_files(text: str) -> str:
    """Return a page with each path replaced by the content of the file."""
    return SHOWN.sub(lambda block: _block(TOP / block[1]), text)


def _block(path: Path) -> str:
    return f"```{LANGUAGES[path.suffix]}\n{path.read_text(encoding='utf-8')}```"
