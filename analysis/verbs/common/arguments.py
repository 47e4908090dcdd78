"""Arguments common to several verbs: requirements on a result's numbers, and paths as arguments or as a list."""

from __future__ import annotations

import os
from collections.abc import Collection, Sequence

from ....common.errors import InputError, suggestion
from ...campaigns.definition.expressions import Expression
from ...options.option import FilePath


def read_requirements(texts: Sequence[str], known: Collection[str], families: tuple[str, ...] = ()) -> list[Expression]:
    """Read requirements on numbers named in ``known`` or with a prefix in ``families``. Raises InputError."""
    requirements = [Expression(text, ("`require`", text)) for text in texts]
    for requirement in requirements:
        for name in sorted(requirement.names - set(known)):
            if not name.startswith(families or ("\0",)):
                raise InputError("`require`", name, "the result has no such number", suggestion(name, known))
    return requirements


def path_list(entries: Sequence[FilePath | Sequence[FilePath]]) -> list[str]:
    """Return the paths of a call, passed as separate arguments or as lists."""
    paths: list[str] = []
    for entry in entries:
        paths += [os.fspath(entry)] if isinstance(entry, str | os.PathLike) else [os.fspath(path) for path in entry]
    return paths
