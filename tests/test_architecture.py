"""The rooms of tests/rooms.toml: imports run down its list only, none in a circle, and no room is crowded.

Truth: the list, and the imports as Python's own parser reads them.
"""

from __future__ import annotations

import ast
import subprocess
import sys
import tomllib
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import pytest

from perilune.common.paths import ROOT

TOPS = ("analysis", "fmus_src", "common")
OURS = {"perilune", *TOPS}
EVERYWHERE = {"common"}
KINDS = (
    "plants",
    "environment",
    "sensors",
    "navigation",
    "guidance",
    "control",
    "actuators",
    "disturbances",
    "sequencing",
)
MOST = 15
LISTS = {
    "analysis/verbs",
    "ssp_systems/landing_mission",  # nine starts
    *(f"fmus_src/{kind}{room}" for kind in KINDS for room in ("", "/checks")),
}  # of things alike, where one looks for a name


def read_rooms() -> dict[str, set[str]]:
    """Room -> what it may import, in the order of the file."""
    rooms = tomllib.loads((ROOT / "tests" / "rooms.toml").read_text(encoding="utf-8"))
    return {
        room.replace("KIND", kind): set(entry["imports"])
        for room, entry in rooms.items()
        for kind in (KINDS if "KIND" in room else ("",))
    }


ROOMS = read_rooms()


def room_of(module: str) -> str:
    """The most particular room of the list that a module, ``analysis.batch.flying.flyer``, lies in."""
    path = module.replace(".", "/")
    inside = [room for room in (*ROOMS, *EVERYWHERE) if path == room or path.startswith(f"{room}/")]
    return max(inside, key=len)


def imports(file: Path) -> Iterator[str]:
    """Modules of ours that a file imports, below perilune."""
    relative = file.relative_to(ROOT).with_suffix("")
    package = list(relative.parts[:-1])
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            assert not any(alias.name.split(".")[0] in OURS for alias in node.names), file
        if isinstance(node, ast.ImportFrom):
            assert node.level or (node.module or "").split(".")[0] not in OURS, file
            if node.level:
                base = [*package[: len(package) - (node.level - 1)], *(node.module or "").split(".")]
                base = [part for part in base if part]
                whole = ROOT.joinpath(*base)
                for alias in node.names:
                    inner = whole / alias.name
                    is_module = inner.with_suffix(".py").is_file() or (inner / "__init__.py").is_file()
                    yield ".".join([*base, alias.name] if is_module else base)


FILES = sorted(path for top in TOPS for path in (ROOT / top).rglob("*.py") if path.name != "__init__.py")


@pytest.fixture(scope="module")
def arrows() -> dict[str, set[tuple[str, str]]]:
    """Room -> (room that it imports, file that does)."""
    actual = defaultdict(set)
    for file in FILES:
        here = room_of(".".join(file.relative_to(ROOT).with_suffix("").parts))
        for module in imports(file):
            there = room_of(module)
            if there != here:
                actual[here].add((there, file.relative_to(ROOT).as_posix()))
    return actual


def test_every_file_has_a_room():
    assert len(FILES) > 200
    for file in FILES:
        assert room_of(".".join(file.relative_to(ROOT).with_suffix("").parts))


def test_imports_are_those_of_the_list(arrows):
    assert len(arrows) > 20
    for room, targets in arrows.items():
        allowed = ROOMS.get(room, set()) | EVERYWHERE
        for target, file in targets:
            assert target in allowed, f"{file}: {room} may not import {target}"


def test_the_list_runs_downwards():
    order = list(ROOMS)
    for room, allowed in ROOMS.items():
        for target in allowed:
            assert order.index(target) > order.index(room), f"{room} -> {target}"


def test_the_list_allows_nothing_that_is_not_used(arrows):
    for room, allowed in ROOMS.items():
        if room.removeprefix("fmus_src/") not in KINDS:
            assert allowed <= {target for target, _ in arrows.get(room, set())}


def test_only_the_command_line_and_the_build_know_the_verbs(arrows):
    """A request is data: only the rooms above it write command lines."""
    importers = {
        here
        for here, pairs in arrows.items()
        if any(target.split("/")[:2] == ["analysis", "verbs"] for target, _ in pairs)
    }
    assert {here for here in importers if here.split("/")[1] != "verbs"} == {"analysis/cli", "analysis/shipped"}


def test_options_lie_on_the_floor_above_common(arrows):
    rooms = {"analysis/options", "analysis/options/declared"}
    assert {target for room in rooms for target, _ in arrows[room]} == {"analysis/options", "common"}
    assert list(ROOMS)[-1] == "analysis/options" or list(ROOMS)[-2] == "analysis/options"


def test_a_request_knows_no_command_line(arrows):
    """Rooms of algorithms import no declaration of a verb, and not the writer of commands."""
    rooms = ("stability", "studies", "campaigns", "design")
    known = {
        (here, target)
        for here, pairs in arrows.items()
        for target, _ in pairs
        if here.split("/")[1:2] and here.split("/")[1] in rooms
    }
    assert len(known) > 30
    assert not [pair for pair in known if pair[1] in ("analysis/options/declared", "analysis/commands")]


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
    targets = {
        target.split("/")[0] for here, pairs in arrows.items() if here.split("/")[0] == room for target, _ in pairs
    }
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
    assert done.stderr.splitlines()[-1] == (
        f"ImportError: {room} is a room of the package perilune: import perilune.{room}"
    )
