"""`perilune export NAME --fmi 3`: output, platforms, and refusals in one line each."""

from __future__ import annotations

import importlib.util
import json
import zipfile
from pathlib import Path

import fmpy
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.fmus_src.export import compilers
from perilune.fmus_src.export.compilers import available_platforms, local_platform, platforms_of

pytestmark = pytest.mark.skipif(local_platform(3) is None, reason="FMI 3.0 libraries are not compiled for this system")
LOCAL = str(local_platform(3))
OTHER = "aarch64-linux" if LOCAL != "aarch64-linux" else "x86_64-linux"
BLOCKS = '''
from perilune import Block, Output, Parameter


class Ramp(Block):
    """A ramp."""

    rate = Parameter(2.0, description="slope")
    y = Output(0.0, description="rate times time")

    def step(self, t: float, h: float) -> None:
        self.y = self.rate * (t + h)


class Library(Block):
    """Needs a library."""

    python_only = True
    y = Output(0.0, description="y")

    def step(self, t: float, h: float) -> None:
        self.y = t
'''


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def libraries(fmu: Path | str) -> set[str]:
    with zipfile.ZipFile(fmu) as archive:
        return {name.split("/")[1] for name in archive.namelist() if name.startswith("binaries/")}


def test_a_block_of_the_catalogue(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", "jet_health", "--fmi", "3", "--platform", LOCAL, "--json", "report.json"]) == 0
    assert capsys.readouterr().out == "jet_health.fmu\nwritten: report.json\n"
    report = {"paths": ["jet_health.fmu"], "flavours": ["native"], "platforms": [LOCAL], "fmi": 3}
    assert report.items() <= json.loads(Path("report.json").read_text()).items()
    assert libraries("jet_health.fmu") == {LOCAL}
    assert fmpy.read_model_description("jet_health.fmu").fmiVersion == "3.0"
    assert perilune.export("jet_health", platforms=[fmpy_platform()], output="two.fmu").fmi == 2
    assert fmpy.read_model_description("two.fmu").fmiVersion == "2.0"


def fmpy_platform() -> str:
    name = local_platform(2)
    return name or pytest.skip("FMI 2.0 has no name for this system")


def test_all_platforms_that_can_be_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    """Export compiles for the usual platforms, in `make test` this machine; without zig for the local one alone."""
    assert perilune.export("jet_health", fmi=3).platforms == tuple(available_platforms(3))
    assert libraries("jet_health.fmu") == set(available_platforms(3))
    monkeypatch.setitem(compilers.USUAL, 3, platforms_of(3))
    if importlib.util.find_spec("ziglang") is not None:
        assert available_platforms(3) == platforms_of(3)
    monkeypatch.setattr(compilers.importlib.util, "find_spec", lambda _: None)
    monkeypatch.setattr(compilers.shutil, "which", lambda name: f"/usr/bin/{name}")
    assert available_platforms(3) == [LOCAL]


def test_the_blocks_of_a_file_go_to_a_folder_of_their_own(capsys: pytest.CaptureFixture[str]) -> None:
    """A folder in which ``use`` does not look; blocks that need Python are left out."""
    Path("blocks.py").write_text(BLOCKS)
    assert main(["export", "blocks.py", "--fmi", "3", "--platform", LOCAL]) == 0
    assert capsys.readouterr().out == "build/fmus/fmi3/ramp.fmu\n"
    assert main(["export", "ramp", "--fmi", "3", "--platform", LOCAL, "--output", "my.fmu"]) == 0
    assert Path("my.fmu").read_bytes() == Path("build/fmus/fmi3/ramp.fmu").read_bytes()
    flown = fmpy.simulate_fmu("my.fmu", stop_time=1.0, step_size=0.25, output_interval=0.25)
    assert flown["y"].tolist() == [0.0, 0.5, 1.0, 1.5, 2.0]


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (
            ["jet_health", "--fmi", "3", "--platform", "linux64"],
            "--platform: linux64: a platform of FMI 2.0; for FMI 3.0 give x86_64-linux, aarch64-linux, x86_64-windows, "
            "x86_64-darwin, aarch64-darwin",
        ),
        (
            ["jet_health", "--platform", "aarch64-linux"],
            "--platform: aarch64-linux: a platform of FMI 3.0; for FMI 2.0 give linux64, win64, darwin64",
        ),
        (
            ["jet_health", "--fmi", "3", "--flavour", "python"],
            "--flavour: python: Python FMUs are FMI 2.0 FMUs; leave out --flavour or --fmi",
        ),
        (
            ["lunar_terminal_guidance", "--fmi", "3", "--ssp", "1"],
            "--ssp: 1: FMI 3.0 FMUs have arrays, which SSP 1.0 does not support; give 2, or leave out --fmi",
        ),
        (["jet_health", "--fmi", "1"], "--fmi: 1: below 2; give 2 or more"),
        (
            ["library", "--fmi", "3", "--platform", LOCAL],
            f"--platform: {LOCAL}: library: needs Python and has no native form; leave out --platform",
        ),
        (
            ["library", "--fmi", "3"],
            "blocks.py: library: needs Python, but Python FMUs are FMI 2.0 FMUs; leave out --fmi",
        ),
        (
            ["library", "--fmi", "3", "--output", "library.fmu"],
            "blocks.py: Library: needs Python, but Python FMUs are FMI 2.0 FMUs; leave out --fmi",
        ),
    ],
)
def test_wrong_requests_are_refused(words: list[str], line: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path("blocks.py").write_text(BLOCKS)
    assert main(["export", *words]) == 2
    assert capsys.readouterr().err == f"perilune: {line}\n"
    assert not list(Path().glob("*.fmu"))


def test_without_a_compiler(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], refusal) -> None:
    monkeypatch.setattr(compilers.shutil, "which", lambda _: None)
    monkeypatch.setattr(compilers.importlib.util, "find_spec", lambda _: None)
    Path("blocks.py").write_text(BLOCKS)
    for name in ("jet_health", "ramp"):
        assert main(["export", name, "--fmi", "3"]) == 2
        element = "jet_health" if name == "jet_health" else "blocks.py"
        line = f"perilune: export: {element}: no C compiler was found; pip install ziglang, or leave out --fmi\n"
        assert capsys.readouterr().err == line
    assert f"no C compiler for {OTHER}: pip install ziglang" in refusal(
        ["export", "jet_health", "--fmi", "3", "--platform", OTHER]
    )
    assert not list(Path().rglob("*.fmu"))
