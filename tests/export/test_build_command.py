"""`perilune export FILE.py`: built FMUs run by name and by path; errors are reported in one line.

Truth: the exit statuses 0 (built) and 2 (wrong input); simulations of the built FMUs with known results.
"""

import pytest

from perilune.analysis.cli import main
from perilune.common.paths import ROOT
from tests.support.builders import BLOCKS, component, document, fly, pack, system

GUIDANCE = '''
from perilune import TerminalGuidance, TerminalStatus


class StraightUp(TerminalGuidance):
    """Thrusts upwards for ten seconds."""

    def solve(self) -> None:
        self.status = TerminalStatus.GOOD
        self.command.thrust_acceleration = 2.0
        self.time_to_go = 1e6
'''


@pytest.fixture
def built(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def run(text, *options, name="mine.py"):
        (tmp_path / name).write_text(text)
        status = main(["export", name, *options])
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return run


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("flavour", ["python", "native"])
def test_a_guidance_from_outside_flies_in_the_slot(built, tmp_path, flavour):
    import perilune

    status, output, error = built(GUIDANCE, "--flavour", flavour)
    assert (status, output, error) == (0, f"build/fmus/{flavour}/straight_up.fmu\n", "")
    for name in ("straight_up", f"build/fmus/{flavour}/straight_up.fmu"):
        result = perilune.simulate("lunar_terminal_guidance", use={"guidance": name}, flavour=flavour, stop_time=5.0)
        assert result["plant.velocity[3]"][-1] == pytest.approx(-47.4802098 + (2.0 - 1.62) * 5.0, rel=1e-9)


def test_blocks_of_one_file_in_any_name(built, tmp_path):
    status, _, error = built(BLOCKS, "--flavour", "python", name="my blocks-2.py")
    assert (status, error) == (0, "")
    folder = tmp_path / "build" / "fmus" / "python"
    assert {path.stem for path in folder.iterdir()} >= {"ramp", "gain", "delay"}
    path = pack(tmp_path / "s.ssp", folder, document(system(component("ramp", "ramp", "output y Real m"))))
    assert fly(path)["ramp.y"].tolist() == [1.0, 1.5, 2.0, 2.5, 3.0]


HEAD = "from perilune.fmus_src.block import Block, Output, Parameter\n"
WRONG = {
    "no Python": ("def", "mine.py: importing it failed: SyntaxError"),
    "no block": ("x = 1\n", "mine.py: defines no block"),
    "no docstring": (HEAD + "class A(Block):\n    pass\n", "write a docstring"),
    "import that cannot be packed": (
        HEAD + 'import lxml\nclass A(Block):\n    """A."""\n    y = Output(0.0, unit="1", description="y")\n'
        "    def step(self, t: float, h: float) -> None:\n        self.y = 1.0\n",
        "import of lxml, which is not packed",
    ),
    "no step": (
        HEAD + 'class A(Block):\n    """A."""\n    y = Output(0.0, description="y")\n',
        "write def step(self, t, h)",
    ),
    "guidance without a law": (
        'from perilune import TerminalGuidance\nclass A(TerminalGuidance):\n    """A."""\n',
        "A: has no solve, which every TerminalGuidance has; write def solve(self) in it",
    ),
    "name that is not declared": (
        HEAD + 'class A(Block):\n    """A."""\n    thrust = Output(0.0, description="y")\n    python_only = True\n'
        "    def step(self, t: float, h: float) -> None:\n        self.thurst = 1.0\n",
        "mine.py:7: self.thurst is not declared in A; did you mean thrust? Else declare it in the class",
    ),
    "name that perilune does not have": (
        'from perilune import Block, Output, Inptu\nclass A(Block):\n    """A."""\n',
        "cannot import name 'Inptu'",
    ),
    "name of perilune that is not packed": (
        HEAD + 'from perilune import simulate\nclass A(Block):\n    """A."""\n    y = Output(0.0, description="y")\n'
        "    def step(self, t: float, h: float) -> None:\n        self.y = 1.0\n",
        "import of perilune.simulate, which is not packed into the FMU",
    ),
    "one that cannot be imported where it is packed": (
        "from pathlib import Path\n" + HEAD + 'assert Path(__file__).parent.name != "outside"\n'
        'class A(Block):\n    """A."""\n    y = Output(0.0, unit="1", description="y")\n'
        "    def step(self, t: float, h: float) -> None:\n        self.y = 1.0\n",
        "mine.py: importing it as it is packed into the FMU failed: AssertionError",
    ),
    "raises": ("raise RuntimeError('100 %')\n", "importing it failed: RuntimeError: 100 %"),
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_files(built, name):
    text, words = WRONG[name]
    status, output, error = built(text, "--flavour", "python")
    assert (status, output) == (2, "")
    assert words in error
    assert error.startswith("perilune: ")
    assert error.count("\n") == 1


def test_a_declaration_error_is_shown(built):
    text = HEAD + 'class A(Block):\n    """A."""\n    y = Output(0.0, unit="ell", description="y")\n'
    assert "unit 'ell' is unknown" in built(text, "--flavour", "python")[2]


def test_a_file_that_is_not_there(tmp_path, monkeypatch, refusal):
    monkeypatch.chdir(tmp_path)
    assert "gone.py: no such file" in refusal(["export", "gone.py"])
    assert not list(tmp_path.iterdir())


def test_a_file_of_the_product(refusal):
    file = ROOT / "fmus_src" / "sensors" / "laser_ranger.py"
    assert f"{file}: a file of Perilune itself; build_fmus.py builds its blocks" in refusal(["export", str(file)])


FILTER = (
    HEAD
    + '''
class FormingFilter(Block):
    """A block of a shipped one's name."""

    y = Output(0.0, description="y")

    def step(self, t: float, h: float) -> None:
        self.y = t + h
'''
)


@pytest.mark.usefixtures("fmus")
def test_a_class_of_a_shipped_name_exports_and_the_users_system_flies_it(built, tmp_path):
    """Also where it has another flavour than the shipped one; Perilune's own systems go on with the shipped one."""
    import perilune

    status, _, message = built(FILTER, "--flavour", "python")
    assert (status, message) == (0, "")
    (tmp_path / "mine").mkdir()
    ssd = document(system(component("filter", "forming_filter", "output y Real 1")))
    (tmp_path / "mine" / "SystemStructure.ssd").write_text(ssd)
    assert perilune.simulate("mine")["filter.y"].tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]
    perilune.export("mine", flavour="python")
    assert perilune.simulate("mine.ssp")["filter.y"].tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert "disturbance" in {each["name"] for each in perilune.describe("forming_filter")["variables"]}
