"""Early start of the server for simulation processes, in parallel with other slow imports of a command."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...fmus_src.own_digests import has_foreign
from ..options.declaration import Verb
from ..options.option import options_of


def start_early(verb: Verb, arguments: Mapping[str, Any], options: Mapping[str, Any]) -> None:
    """Start the server if a command will simulate in processes: foreign FMUs, or campaigns with Python FMUs."""
    if "in_process" not in options_of(verb.options) or options.get("in_process"):
        return
    files = [arguments.get("system"), *arguments.get("files", ()), *options.get("use", {}).values()]
    in_processes = "engine" in options_of(verb.options) and (
        options.get("engine") == "processes" or (options.get("flavour") == "python" and options.get("workers") != 1)
    )
    if in_processes or any(has_foreign(Path(file)) for file in files if file is not None):
        from ..runtime.process.children import CAN_FORK, start_server  # imports numpy, which not all verbs need

        if CAN_FORK:
            start_server()
