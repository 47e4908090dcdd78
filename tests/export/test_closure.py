"""Content of a Python FMU: exactly the block's import closure, under a name derived from its content.

Truth: blocks written here with known imports; Python, which runs the packed files outside this repository.
"""

import subprocess
import sys

import pytest

from perilune.fmus_src.catalogue import blocks_in_file, catalogue
from perilune.fmus_src.export.closure import ClosureError, closure_of

HEAD = "from perilune.fmus_src.block import Block, Output\n"
BODY = '''

class Outside(Block):
    """A block from outside."""

    y = Output(0.0, unit="1", description="a number")

    def initialize(self) -> None:
        self.y = {value}

    def step(self, t: float, h: float) -> None:
        self.y = {value}
'''


def block(folder, imports="", value="1.0", name="outside.py"):
    path = folder / name
    path.write_text(HEAD + imports + BODY.format(value=value))
    (actual,) = blocks_in_file(path)
    return actual


def runs(closure, folder, class_name="Outside"):
    """Run the packed files where the repository cannot be imported; return the output at the start."""
    for name, text in closure.pack_closure().items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(text)
    code = (
        f"import sys; sys.path.insert(0, {str(folder)!r})\n"
        f"from {closure.package}.{closure.block_module} import {class_name} as block\n"
        f"from {closure.package}.runtime import BlockInstance\n"
        "component = BlockInstance(block); component.start(); print(component.block.y)\n"
        "assert not any(name.split('.')[0] in ('fmus_src', 'analysis', 'common') for name in sys.modules)\n"
    )
    done = subprocess.run([sys.executable, "-I", "-c", code], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return float(done.stdout)


IMPORTS = {
    "a function": ("from perilune.fmus_src.mathlib.vectors import norm, vector\n", "norm(vector(3.0, 4.0, 0.0))", 5.0),
    "names of the face": ("from perilune import (\n    norm,\n    vector,\n)\n", "norm(vector(3.0, 4.0, 0.0))", 5.0),
    "a name of the face that a module has, too": ("from perilune import block\n", "float(block(2, 3).stop)", 5.0),
    "a module": ("from perilune.fmus_src.mathlib import vectors\n", "vectors.norm(vectors.vector(3.0, 4.0, 0.0))", 5.0),
    "a module by another name": (
        "from perilune.fmus_src.mathlib import vectors as v\n",
        "v.norm(v.vector(0.0, 0.0, 2.0))",
        2.0,
    ),
    "several modules": (
        "from perilune.fmus_src.mathlib import polynomial, vectors\n",
        "vectors.norm(vectors.vector(0.0, 2.0, 0.0)) + 0.0 * len(polynomial.__name__)",
        2.0,
    ),
    "a standard module": ("import math\nfrom fractions import Fraction\n", "math.sqrt(Fraction(9, 1))", 3.0),
}


@pytest.mark.parametrize("name", IMPORTS)
def test_imports_of_every_form_are_packed(tmp_path, name):
    imports, value, expected = IMPORTS[name]
    closure = closure_of(block(tmp_path, imports, value))
    (tmp_path / "away").mkdir()
    assert runs(closure, tmp_path / "away") == expected


@pytest.mark.parametrize("name", ["block.py", "runtime.py", "units.py", "my-guidance.py", "2nd block.py"])
def test_a_file_may_have_any_name(tmp_path, name):
    closure = closure_of(block(tmp_path, value="7.0", name=name))
    (tmp_path / "away").mkdir()
    assert runs(closure, tmp_path / "away") == 7.0


@pytest.mark.parametrize(
    "imports",
    [
        "import requests\n",
        "from perilune.analysis import api\n",
        "import helper\n",
        "import perilune.fmus_src.mathlib.vectors\n",
    ],
)
def test_what_cannot_be_packed_is_refused_with_its_line(tmp_path, imports):
    path = tmp_path / "outside.py"
    guarded = f"if False:\n    {imports}"
    path.write_text(HEAD + guarded + BODY.format(value="1.0"))
    (actual,) = blocks_in_file(path)
    with pytest.raises(ClosureError, match=r"outside\.py:3: import of .*not packed into the FMU; .*requires"):
        closure_of(actual)


def test_libraries_that_a_block_requires_are_let_through(tmp_path):
    actual = block(tmp_path, "if False:\n    import filterpy\n")
    actual.requires = ("filterpy",)
    assert b"import filterpy" in closure_of(actual).files["outside/outside.py"]


def test_the_name_follows_the_content(tmp_path):
    first = closure_of(block(tmp_path, value="1.0"))
    repeated = closure_of(block(tmp_path, value="1.0"))
    changed = closure_of(block(tmp_path, value="2.0"))
    assert first.package == repeated.package != changed.package


def test_no_more_than_the_closure():
    closure = closure_of(catalogue()["ideal_navigation"])
    assert not any("kalman" in name or "plants" in name or "export/c_" in name for name in closure.files)
    assert {"navigation/ideal.py", "interfaces/navigation.py", "block.py", "runtime.py"} <= set(closure.files)


def test_nothing_of_the_repository_is_imported_by_a_packed_file():
    for actual in catalogue().values():
        for name, text in closure_of(actual).pack_closure().items():
            for line in text.decode().splitlines():
                assert not line.strip().startswith(("from fmus_src", "import fmus_src", "from analysis")), (name, line)
