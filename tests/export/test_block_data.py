"""Blocks with data files and modules: declared files are packed into the FMU, and no other files are needed.

Truth: the numbers in the files; the plain Python object; a process without access to the folder and this repository.
"""

import shutil
import subprocess
import sys
import zipfile

import numpy as np
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.stale import report_fmus
from perilune.fmus_src.catalogue import blocks_in_file
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
from perilune.fmus_src.runtime import BlockInstance
from perilune.fmus_src.user_modules import import_file

BLOCK = '''"""A table looked up."""
from functools import cache

{imports}
import numpy as np
from perilune import Block, Input, Output, State


@cache
def table(path):
    return np.load(path)["gain"]


class MyTable(Block):
    """y = scale gain u, with the gain of a file."""

    python_only = True
    data = ("net.npz",)
    u = Input(1.0, description="in")
    y = Output(0.0, direct=True, description="out")

    def initialize(self) -> None:
        self.y = {scale} * float(table(self.data_path("net.npz"))[0]) * self.u

    def step(self, t: float, h: float) -> None:
        self.initialize()
'''
HELPER = "import constants, math\n\n\ndef scale():\n    return math.copysign(constants.TWO, 1.0)\n"
IMPORTS = {
    "relative": ("from .helper import scale", "scale()"),
    "absolute": ("from helper import (\n    scale,\n)", "scale()"),
    "module": ("import helper", "helper.scale()"),
    "another name": ("import math, helper as h", "h.scale()"),
    "of the folder": ("from . import helper", "helper.scale()"),
}


def write(folder, imports="from .helper import scale", scale="scale()", gain=3.0, block=BLOCK):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "my_table.py").write_text(block.format(imports=imports, scale=scale))
    (folder / "helper.py").write_text(HELPER)
    (folder / "constants.py").write_text("TWO = 2.0\n")
    np.savez(folder / "net.npz", gain=np.array([gain]))
    return folder / "my_table.py"


@pytest.fixture
def here(tmp_path, monkeypatch):
    folder = tmp_path / "mine"
    write(folder)
    monkeypatch.chdir(folder)
    return folder


FLY = """
import os, sys
from fmpy import simulate_fmu
result = simulate_fmu(sys.argv[1], stop_time=1.0, step_size=0.5, start_values={"u": 1.5}, output=["y"])
print(float(result["y"][-1]), flush=True)
assert not any(name == "perilune" for name in sys.modules)
os._exit(0)
"""


@pytest.mark.parametrize("form", IMPORTS)
def test_modules_and_data_travel(tmp_path, form):
    """2 from a module's module, 3 from the file, 1.5 from outside: 9, as an object and in an FMU away from it all."""
    (block,) = blocks_in_file(write(tmp_path / "mine", *IMPORTS[form]))
    component = BlockInstance(block)
    component.block.u = 1.5
    component.start()
    assert component.block.y == 9.0
    fmu = build_python_fmu(block, tmp_path / "away" / "my_table.fmu")
    first = fmu.read_bytes()
    assert build_python_fmu(block, fmu).read_bytes() == first
    shutil.rmtree(tmp_path / "mine")
    command = [sys.executable, "-I", "-c", FLY, str(fmu)]
    done = subprocess.run(command, cwd=tmp_path / "away", capture_output=True, text=True, check=False)
    assert done.stdout.strip() == "9.0", done.stderr


def test_exported_by_name_and_flown(here, capsys, refusal):
    """By the file's name and by the class's; flown twice in one process, and again with other data."""
    assert main(["export", "my_table"]) == 0
    assert capsys.readouterr().out.split() == ["build/fmus/python/my_table.fmu"]
    fly = {"stop_time": 0.2, "step": 0.1, "open_inputs": "start"}
    for _ in range(2):
        assert perilune.simulate("build/fmus/python/my_table.fmu", **fly)["my_table.y"][-1] == 6.0
    (here / "my_table.py").rename(here / "other.py")
    np.savez(here / "net.npz", gain=np.array([5.0]))
    assert main(["export", "my_table"]) == 0
    assert perilune.simulate("build/fmus/python/my_table.fmu", **fly)["my_table.y"][-1] == 10.0
    (here / "third.py").write_text("class MyTable:\n    pass\n")
    assert "my_table: defined in other.py, third.py; give the path of one of these files" in refusal(
        ["export", "my_table"]
    )


@pytest.mark.parametrize("changed", ["net.npz", "helper.py", "constants.py"])
def test_a_change_of_any_of_the_files_is_noticed(here, changed):
    perilune.export("my_table.py")
    options = SystemOptions(use={"guidance": "my_table"})
    assert report_fmus("lunar_terminal_guidance", options, {}) == []
    (here / changed).write_bytes((here / changed).read_bytes() + b"\n")
    (line,) = report_fmus("lunar_terminal_guidance", options, {})
    assert line == f"{changed}: has changed since my_table was exported; perilune export my_table.py"


def test_a_native_fmu_of_before_does_not_fly_in_its_place(here):
    text = (here / "my_table.py").read_text()
    plain = text.replace("python_only = True", "").replace('data = ("net.npz",)', "").replace("scale() * float(", "(")
    (here / "my_table.py").write_text(plain.replace('table(self.data_path("net.npz"))[0]', "1.0"))
    exported = perilune.export("my_table", platforms=[local_platform()])
    assert "native" in exported.flavours
    (here / "my_table.py").write_text(text)
    assert perilune.export("my_table").flavours == ("python",)
    assert [path.parent.name for path in here.glob("build/fmus/*/my_table.fmu")] == ["python"]


REFUSED = {
    "missing": (
        ("net.npz", "gone.npz"),
        "my_table.py: MyTable: data names gone.npz, which is not next to",
    ),
    "absolute": (("net.npz", "/etc/hostname"), "data names '/etc/hostname', which is not a file next to the"),
    "above": (("net.npz", "../net.npz"), "data names '../net.npz', which is not a file next to the source"),
    "below": (("net.npz", "x/net.npz"), "data names 'x/net.npz', which is not a file next to the source"),
    "elsewhere": (("net.npz", "x\\\\net.npz"), "which is not a file next to the source"),
    "nothing": (("net.npz", ""), "data names '', which is not a file next to the source"),
    "a module": (("net.npz", "helper.py"), "data names 'helper.py', which is Python; import it"),
    "text": (('("net.npz",)', '"net.npz"'), "data is 'net.npz'; write a tuple of file names"),
    "native": (("python_only = True", ""), "data net.npz: a native FMU reads no files; add python_only = True"),
    "no module": (("from .helper", "from .helpers"), "ModuleNotFoundError: no helpers.py next to it"),
    "above it": (
        ("from .helper import", "if False:\n    from ..helper import"),
        "my_table.py:5: import of ..helper, which is not",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_travel_is_refused_in_one_line(here, capsys, case):
    (old, new), words = REFUSED[case]
    text = (here / "my_table.py").read_text()
    declared, remainder = text.partition("    u = Input")[::2]
    assert old in declared
    (here / "my_table.py").write_text(declared.replace(old, new) + "    u = Input" + remainder)
    before = sorted(here.rglob("*"))
    assert main(["export", "my_table.py"]) == 2
    error = capsys.readouterr().err
    assert error.startswith("perilune: ")
    assert error.count("\n") == 1
    assert words in error, error
    assert sorted(here.rglob("*")) == before


def test_a_module_that_is_no_python_is_named(here, refusal):
    (here / "helper.py").write_text("a = = 1\n")
    assert "SyntaxError: invalid syntax (helper.py, line 1)" in refusal(["export", "my_table.py"])


@pytest.mark.parametrize(("head", "encoding"), [("", "utf-8-sig"), ("# coding: latin-1\n", "latin-1")])
def test_sources_in_other_encodings(tmp_path, head, encoding):
    (tmp_path / "helper.py").write_text("k = 3.0\n")
    path = tmp_path / "gain.py"
    path.write_bytes(f'{head}from helper import k; x = "\u00e4"; import helper\n'.encode(encoding))
    module = import_file(path)
    assert (module.k, module.x, module.helper.k) == (3.0, "\u00e4", 3.0)


@pytest.mark.parametrize("name", ["my_table", "my_table.py"])
def test_a_platform_for_python_alone_is_refused(here, capsys, name):
    assert main(["export", name, "--platform", local_platform()]) == 2
    expected = (
        f"perilune: --platform: {local_platform()}: my_table: needs Python and has no native form; leave out --platform"
    )
    assert capsys.readouterr().err.strip() == expected
    assert not (here / "build").exists()


def test_only_what_is_declared_is_packed(here):
    (here / "other.npz").write_bytes(b"x")
    (here / "unused.py").write_text("raise ValueError\n")
    (path,) = perilune.export("my_table").paths
    with zipfile.ZipFile(path) as archive:
        packed = {name.rpartition("/")[2] for name in archive.namelist() if "/outside/" in name}
    assert packed == {"__init__.py", "my_table.py", "helper.py", "constants.py", "net.npz"}


def test_the_path_of_what_is_not_declared(here):
    (block,) = blocks_in_file(here / "my_table.py")
    with pytest.raises(ValueError, match=r"MyTable: no data file 'x'; declare it in the class, data = \('x',\)"):
        block().data_path("x")
