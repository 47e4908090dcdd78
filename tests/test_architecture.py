"""Imports follow the order of folders in tests/folders.toml, read from top to bottom.

Truth: the list, and the imports as read by Python's parser.
"""

from __future__ import annotations

import subprocess
import sys
from collections import defaultdict
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

from perilune.common.paths import ROOT
from tests.folders import FILES, FOLDERS, TOPS, folder_of, importing_files, imports, module_of

MOST = 15
KINDS = [name for name, contents in FOLDERS.items() if contents.startswith("blocks: ")]
LISTS = {
    "analysis/verbs",
    "ssp_systems/landing_mission",  # nine starts
    *(f"{kind}{room}" for kind in KINDS for room in ("", "/checks")),
}  # of things alike, where one looks for a name


@pytest.fixture(scope="module")
def arrows() -> dict[tuple[str, str], str]:
    """Return (importing folder, imported folder) of the list -> a file that does."""
    return {
        (folder_of(module_of(ROOT / file)), folder_of(module)): f"{file}: {module}"
        for pairs in importing_files().values()
        for file, module in pairs
    }


def test_every_file_lies_in_a_folder_of_the_list():
    assert len(FILES) > 200
    tops = {"/".join(file.relative_to(ROOT).parts[:2]) for file in FILES if file.parent.parent != ROOT.parent}
    assert len(FOLDERS) < 40
    assert {each for each in tops if (ROOT / each).is_dir() and not each.startswith("common/")} <= set(FOLDERS)


def test_folder_order_is_import_order(arrows):
    order = list(FOLDERS)
    assert len(arrows) > 100
    for (here, there), file in arrows.items():
        assert order.index(there) >= order.index(here), f"{file}: {there} is above {here} in tests/folders.toml"


def test_kinds_of_blocks_know_only_the_bases(arrows):
    """A guidance imports no plant: they meet in systems."""
    assert len(KINDS) == 9
    assert not [(here, there) for here, there in arrows if here in KINDS and there in KINDS and here != there]


def test_files_import_in_no_circle():
    """Within a folder, too; imports within functions and for type checkers included."""
    modules = {module_of(file) for file in FILES}
    graph = {module_of(file): modules.intersection(imports(file)) for file in FILES}
    assert sum(map(len, graph.values())) > 2000
    TopologicalSorter(graph).prepare()  # raises CycleError


def test_only_the_command_line_and_the_build_know_the_verbs(arrows):
    """A request is data: only what stands above it writes command lines."""
    assert {here for here, there in arrows if there == "analysis/verbs"} == {"analysis", "analysis/verbs"}


def test_options_lie_on_the_floor_above_common(arrows):
    assert {there for here, there in arrows if here == "analysis/options"} == {"analysis/options", "common"}


def test_algorithms_know_no_command_line():
    """They import no declaration of a verb, and not the writer of commands."""
    above = ("analysis.options.declared", "analysis.commands")
    rooms = tuple(f"analysis/{name}" for name in ("stability", "studies", "campaigns", "design"))
    known = [
        (file, module)
        for folder, pairs in importing_files().items()
        if folder.startswith(rooms)
        for file, module in pairs
    ]
    assert len(known) > 500
    assert not [(file, module) for file, module in known if module.startswith(above)]


def test_no_room_is_crowded():
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    count = defaultdict(int)
    for name in listed:
        count[str(Path(name).parent.as_posix())] += Path(name).name != "__init__.py"
    assert len(count) > 40
    crowded = {folder: files for folder, files in count.items() if files > MOST and folder not in LISTS}
    assert crowded == {}


IMPORT_ALL = """
import importlib, pkgutil, sys
import perilune.{room} as room
for module in pkgutil.walk_packages(room.__path__, room.__name__ + "."):
    importlib.import_module(module.name)
print(*sys.modules)
"""


@pytest.mark.parametrize(("room", "below"), [("fmus_src", {"common"}), ("common", set())])
def test_a_floor_imports_what_is_below_it_only(room, below, arrows):
    """Within functions, too."""
    targets = {there.split("/")[0] for here, there in arrows if here.split("/")[0] == room}
    assert targets - {room} == below


@pytest.mark.parametrize(("room", "modules"), [("fmus_src", 250), ("common", 20)])
def test_a_floor_brings_no_analysis(room, modules):
    """Modules of a process that has imported every module of a floor."""
    done = subprocess.run(
        [sys.executable, "-c", IMPORT_ALL.format(room=room)], cwd=ROOT, capture_output=True, text=True, check=True
    )
    imported = done.stdout.split()
    assert sum(name.startswith(f"perilune.{room}.") for name in imported) > modules
    assert not [name for name in imported if name.startswith("perilune.analysis")]


@pytest.mark.parametrize("room", TOPS)
def test_a_room_is_no_package_of_its_own(room):
    """A second copy of InputError would not be caught."""
    done = subprocess.run(
        [sys.executable, "-c", f"import {room}"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1] == (f"ImportError: {room} is a subpackage of perilune: import perilune.{room}")
