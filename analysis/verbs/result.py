"""Output of a verb's result on the command line: text, JSON, files, exit status."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

from ...common.atomic import write_atomically
from ...common.errors import ExitStatus, InputError, name_by_flags
from ...common.targets import Results, check_file, check_folder
from ..compose.files import report_changed_source
from ..options.declaration import Verb
from ..options.option import Kind, defaults_of, options_of
from ..options.parsing import flags_of
from ..runtime.system.options import system_options
from ..runtime.system.stale import report_fmus
from .common.browser import open_page, require_browser
from .common.documented import Documented

STANDARD_OUTPUT = "-"


# The method of a result that writes the file of an option, unless the option names another one.
WRITERS = {"report": "report", "output": "write", "data": "write_data"}


def check_files(verb: Verb, options: Mapping[str, Any], files: Mapping[str, Any]) -> None:
    """Reject files that cannot be written, and options that need a missing file, before any work. Raises InputError."""
    declared = options_of(verb.files)
    everything = {**options_of(verb.options), **declared}
    for name, path in files.items():
        if declared[name].kind is Kind.PATH and str(path) != STANDARD_OUTPUT:
            option = declared[name].option
            if option.is_folder:
                check_folder(f"`{name}`", Path(path), overwrite=True)
            else:
                check_file(f"`{name}`", Path(path), option.suffixes)
    for name, value in {**options, **files}.items():
        needed = everything[name].option.needs
        if needed and {**options, **files}.get(needed) is None:
            text = "" if value is True else str(value)
            raise InputError(f"`{name}`", text, f"has no effect unless `{needed}` is given", "give both or neither")
    if "open" in files:
        require_browser("`open`")


def report_state_of_fmus(verb: Verb, arguments: Mapping[str, Any], options: Mapping[str, Any]) -> None:
    """Print a line on standard error for each source that changed since its FMU or SSD was built from it."""
    if "system" not in arguments or "use" not in options_of(verb.options):
        return
    complete = {**defaults_of(verb.options), **options}
    system = arguments["system"]
    lines = report_fmus(system, system_options(complete), options.get("compare", {}))
    for line in [*lines, *report_changed_source(system)]:
        print(f"perilune: {line}", file=sys.stderr)


def output_result(verb: Verb, result: Documented, files: Mapping[str, Any]) -> ExitStatus:
    """Print a result or its JSON document, write its files, report its problems; return the exit status."""
    written, declared, flags = Results(), options_of(verb.files), flags_of(verb)
    written.written += [folder] if (folder := getattr(result, "folder", None)) is not None else []
    target = files.get("json")
    if target == STANDARD_OUTPUT:
        sys.stdout.write(_json_text(result))
    else:
        for line in result.lines():
            print(name_by_flags(line, flags))
    for name in reversed(list(declared)):  # the verb's files first, then its page, finally the JSON document
        path, writer = files.get(name), declared[name].option.writer or WRITERS.get(name)
        if writer and path is not None:
            written.write(Path(path), partial(_call, result, writer))
        elif name == "json" and target not in (None, STANDARD_OUTPUT):
            written.write(Path(target), lambda file: write_atomically(file, _json_text(result).encode()))
    if target != STANDARD_OUTPUT:
        written.print_paths()
    problems = result.problems()
    for line in problems:
        print(f"perilune: {name_by_flags(line, flags)}", file=sys.stderr)
    if "open" in files and not written.failed:
        open_page("`open`", written.home / files["report"])
    if written.failed:
        return ExitStatus.REFUSED
    return getattr(result, "problem_status", ExitStatus.NOT_MET) if problems else ExitStatus.MET


def _json_text(result: Documented) -> str:
    return json.dumps(result.to_json(), indent=1, allow_nan=False) + "\n"


def _call(result: Documented, method: str, path: Path) -> None:
    getattr(result, method)(path)
