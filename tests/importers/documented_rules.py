"""Rules that importers document for FMUs, each as a check of an FMU's description and files."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import fmpy
from fmpy.model_description import ModelDescription

Check = Callable[[ModelDescription, frozenset[str]], bool]
IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,62}\Z")
WINDOWS = "library for 64-bit Windows"


@dataclass(frozen=True)
class Rule:
    """A rule by its ``name``, which the page has, and the check that an FMU's description and member names pass."""

    name: str
    check: Check


def lists_its_sources(description: ModelDescription, members: frozenset[str]) -> bool:
    """Return True if the listed C files are exactly those of the folder sources."""
    listed = {
        f"sources/{name}"
        for configuration in description.buildConfigurations
        for files in configuration.sourceFileSets
        for name in files.sourceFiles
    }
    return listed == {name for name in members if name.startswith("sources/") and name.endswith(".c")}


RULES = (
    Rule("co-simulation", lambda description, _: description.coSimulation is not None),
    Rule(
        "no external tool",
        lambda description, _: description.coSimulation is not None and not description.coSimulation.needsExecutionTool,
    ),
    Rule(
        "step size in the default experiment",
        lambda description, _: (
            description.defaultExperiment is not None and bool(description.defaultExperiment.stepSize)
        ),
    ),
    Rule(
        "C identifier as model identifier",
        lambda description, _: (
            description.coSimulation is not None
            and IDENTIFIER.match(description.coSimulation.modelIdentifier) is not None
        ),
    ),
    Rule("source code", lambda _, members: any(re.match(r"sources/.*\.c\Z", name) for name in members)),
    Rule("exactly its C files listed", lists_its_sources),
    Rule(
        "no String and Binary variables",
        lambda description, _: all(
            variable.type not in ("String", "Binary") for variable in description.modelVariables
        ),
    ),
    Rule(
        WINDOWS,
        lambda _, members: any(re.match(r"binaries/(win64|x86_64-windows)/.*\.dll\Z", name) for name in members),
    ),
    Rule(
        "library for 64-bit Linux",
        lambda _, members: any(re.match(r"binaries/(linux64|x86_64-linux)/.*\.so\Z", name) for name in members),
    ),
)


def broken_rules(fmu: Path) -> list[str]:
    """Return the names of the rules that an FMU breaks."""
    with zipfile.ZipFile(fmu) as archive:
        members = frozenset(archive.namelist())
    description = fmpy.read_model_description(str(fmu), validate=False)
    return [rule.name for rule in RULES if not rule.check(description, members)]
