"""Paths of a call that takes them one by one, or as a list."""

from __future__ import annotations

import os
from collections.abc import Sequence

from ..options.option import FilePath


def path_list(given: Sequence[FilePath | Sequence[FilePath]]) -> list[str]:
    """Paths of a call that takes them one by one, or as a list."""
    paths: list[str] = []
    for entry in given:
        paths += [os.fspath(entry)] if isinstance(entry, str | os.PathLike) else [os.fspath(path) for path in entry]
    return paths
