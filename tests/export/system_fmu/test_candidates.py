"""Different candidates for a component of a system FMU, and FMUs that a system FMU cannot contain.

Truth: the systems with one candidate, and closed forms.
"""

import subprocess

import fmpy
import pytest

import perilune
from perilune.common.errors import InputError
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.own_blocks import build_own_blocks
from tests.support.builders import component, connection, document, inline, pack, system
from tests.support.native.system_fmus import Slave, build_one, fly_one

BLOCKS = '''
"""Blocks that give their parameter, each in units of its own."""

from perilune import Block, Output, Parameter


class InMetres(Block):
    """y = start."""

    start = Parameter(2.0, unit="m", description="start")
    y = Output(0.0, unit="m", description="it")

    def initialize(self) -> None:
        self.y = self.start

    def step(self, t: float, h: float) -> None:
        self.y = self.start


class InKilometres(Block):
    """y = start, twice = 2 start + only."""

    start = Parameter(2.0, unit="km", description="start")
    only = Parameter(0.5, unit="km", description="of this block alone")
    y = Output(0.0, unit="km", description="it")
    twice = Output(0.0, unit="km", description="twice it, and more")

    def initialize(self) -> None:
        self.y = self.start
        self.twice = 2.0 * self.start + self.only

    def step(self, t: float, h: float) -> None:
        self.y = self.start


class Math(Block):
    """y = 1; a file of this name would hide one of the C library."""

    y = Output(0.0, unit="m", description="one")

    def initialize(self) -> None:
        self.y = 1.0

    def step(self, t: float, h: float) -> None:
        self.y = 1.0
'''


@pytest.fixture(scope="module")
def fmus(tmp_path_factory):
    """Return the folder of the blocks as native FMUs."""
    folder = tmp_path_factory.mktemp("blocks")
    (folder / "blocks.py").write_text(BLOCKS)
    build_own_blocks(folder / "blocks.py", folder / "fmus", ["native"], [local_platform()])
    return folder / "fmus" / "native"


@pytest.fixture
def slotted(fmus, tmp_path):
    """Return a system whose parameter k (m) goes to a component, and its two candidates."""
    ssd = document(
        system(
            component("c", "in_metres", "parameter start Real; output y Real"),
            connections=connection("k", "c.start") + connection("c.y", "y"),
            declared="parameter k Real m; output y Real m",
            bindings=inline("k=Real:1500 m"),
        )
    )
    slots = {"c": [str(fmus / f"{name}.fmu") for name in ("in_metres", "in_kilometres")]}
    return pack(tmp_path / "s.ssp", fmus, ssd), slots


@pytest.mark.parametrize("order", [1, -1])
def test_a_parameter_of_the_system_in_the_unit_of_each(slotted, tmp_path, order):
    path, slots = slotted
    candidates = slots["c"][::order]
    fmu = build_one(tmp_path / "one.fmu", path, {"c": candidates})
    for number, candidate in enumerate(candidates, 1):
        native = perilune.simulate(path, use={"c": candidate}, set={"k": 3000.0})["y"][0]
        assert fly_one(fmu, {"k": 3000.0, "c.use": number})["y"][0] == native == 3000.0


def test_one_variable_cannot_stand_for_two_units(slotted, tmp_path):
    path, slots = slotted
    problem = "slots: c.y: Real in m, Real in km, depending on the candidate: one variable cannot represent both"
    for options in ({"exposed": ["c.y"]}, {"faulty": ["c.y"]}):
        with pytest.raises(InputError, match=problem):
            build_one(tmp_path / "one.fmu", path, slots, **options)


def test_what_one_candidate_has_alone(slotted, tmp_path):
    """Closed form: 2 * 1.5 km and the set value."""
    path, slots = slotted
    fmu = build_one(tmp_path / "one.fmu", path, slots, ["c.twice"], set={"c.in_kilometres.only": 0.25})
    assert [fly_one(fmu, {"c.use": number})["c.twice"][0] for number in (1, 2)] == [0.0, 3.25]
    with pytest.raises(InputError, match=r"expose: c\.only: a parameter, which is always a parameter of the FMU"):
        build_one(tmp_path / "one.fmu", path, slots, ["c.only"])
    with pytest.raises(InputError, match=r"matches no parameter.*; for a slot write SLOT\.CANDIDATE\.PARAMETER"):
        build_one(tmp_path / "one.fmu", path, slots, set={"c.only": 0.25})
    with pytest.raises(InputError, match="expose: y: a connector of the system, which is always a variable of the FMU"):
        build_one(tmp_path / "one.fmu", path, slots, ["y"])


def test_names_of_types_are_no_names_of_variables(slotted, tmp_path):
    """FMI 2.0.4, 2.2.3."""
    path, slots = slotted
    fmu = build_one(tmp_path / "one.fmu", path, {"c": slots["c"][:1]}, faulty=["c.y"])
    description = Slave(fmu, tmp_path / "one").description
    types = {each.name for each in description.typeDefinitions}
    assert types == {"c.use.Candidate", "FaultKind"}
    assert not types & {each.name for each in description.modelVariables}


def test_a_block_called_as_a_header(fmus, tmp_path):
    ssd = document(system(component("a??/", "math", "output y Real m")))
    fmu = build_one(tmp_path / "one.fmu", pack(tmp_path / "s.ssp", fmus, ssd), exposed=["a??/.y"])
    folder = fmpy.extract(str(fmu), str(tmp_path / "one"))
    command = ["gcc", "-std=c99", "-Wall", "-Werror", "-I.", "-fsyntax-only", "s.c"]
    assert subprocess.run(command, cwd=f"{folder}/sources", check=False).returncode == 0
    assert fly_one(fmu)["a??/.y"][0] == 1.0


def test_a_system_as_one_fmu_inside_another(slotted, tmp_path):
    path, _ = slotted
    (tmp_path / "fmus").mkdir()
    build_one(tmp_path / "fmus" / "inner.fmu", path)
    outer = pack(tmp_path / "o.ssp", tmp_path / "fmus", document(system(component("i", "inner", "output y Real m"))))
    with pytest.raises(InputError, match="is itself a system as one FMU; nest its system"):
        build_one(tmp_path / "two.fmu", outer, exposed=["i.y"])


def test_candidates_in_python(tmp_path):
    with pytest.raises(InputError, match=r"slots: guidance: 3 is not a list of FMUs; give names or paths"):
        perilune.export("lunar_terminal_guidance", as_fmu=True, slots={"guidance": 3})
