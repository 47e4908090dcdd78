"""Errors of a new user at the command line: one line that names place and remedy, status 2, nothing written.

Truth: the folder before and after; words that a reader needs to find the place. Errors inside systems and FMUs are
tested in tests/runtime/system/refusals.
"""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from perilune.analysis.cli import main

pytestmark = pytest.mark.usefixtures("fmus")
SYSTEM = "lunar_terminal_guidance"
RUN = ["run", SYSTEM]
BATCH = ["batch", SYSTEM, "--campaign", "paper"]

SSV = """<?xml version="1.0" encoding="UTF-8"?>
<ssv:ParameterSet version="1.0" name="mine"
    xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssv:Parameters>
    <ssv:Parameter name="{name}"><ssv:Real value="{value}" unit="{unit}"/></ssv:Parameter>
  </ssv:Parameters>
  <ssv:Units><ssc:Unit name="s"><ssc:BaseUnit s="1"/></ssc:Unit></ssv:Units>
</ssv:ParameterSet>
"""
SSD = """<ssd:SystemStructureDescription version="1.0" name="robot"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="robot"><ssd:Elements>
    <ssd:Component name="control" source="attitude_control.fmu">
      <ssd:Connectors>
        <ssd:Connector name="torque_command[1]" kind="output"><ssc:Real unit="N.m"/></ssd:Connector>
      </ssd:Connectors>
    </ssd:Component>
  </ssd:Elements></ssd:System>
  <ssd:Units>
    <ssc:Unit name="N.m"><ssc:BaseUnit kg="1" m="{torque}" s="-2"/></ssc:Unit>
  </ssd:Units>
  <ssd:DefaultExperiment startTime="0" stopTime="4"/>
  <ssd:Annotations>
    <ssc:Annotation type="org.perilune.{ours}">
      <Stability xmlns="https://perilune.org/{content}">
        <Point name="there" time="1">
          <Set name="control.lead_tim" value="1"/>
        </Point>
        <Loop name="loop" cut="control.torque_command[1]" points="there"/>
      </Stability>
    </ssc:Annotation>
  </ssd:Annotations>
</ssd:SystemStructureDescription>
"""
CAMPAIGN = """
system = "lunar_terminal_guidance"
trials = 2
seed = 1
[success]
expression = "1 < 2"
"""
BLOCK = '''"""A block."""
{imports}
from perilune import Block, Input, Output, TerminalGuidance, vector


class Mine({base}):
    """A block."""

{declared}
    def {method}:
        {body}
'''


PARAMETER = "from perilune import Parameter\n"


def block(
    body="self.y = self.u", declared="", base="Block", method="step(self, t: float, h: float) -> None", imports=""
):
    values = (
        '    u = Input(0.0, description="in")\n    y = Output(0.0, description="out")\n'
        '    v = Output([0.0, 0.0, 0.0], description="out")\n'
    )
    return BLOCK.format(body=body, declared=declared + values, base=base, method=method, imports=imports)


def zipped(path, files):
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)


@pytest.fixture
def working(tmp_path, monkeypatch):
    """Return the user's folder, with the files that the table names."""
    monkeypatch.chdir(tmp_path)
    for name, text in {
        "no_system.ssv": SSV.format(name="plnt.initial_mass", value="1", unit="s"),
        "wrong_unit.ssv": SSV.format(name="plant.initial_mass", value="1", unit="s"),
        "unknown_unit.ssv": SSV.format(name="plant.initial_mass", value="1", unit="stone"),
        "no_number.ssv": SSV.format(name="plant.initial_mass", value="heavy", unit="s"),
        "cut.ssv": SSV[:300],
        "cut.toml": 'system = "lunar_terminal_guidance\n',
        "key.toml": CAMPAIGN + "[sucess]\nexpression = 'true'\n",
        "draw.toml": CAMPAIGN + '[draw."plant.mass"]\ndistribution = "gaussian"\nmean = 0\nsigma = 1\n',
        "metric.toml": CAMPAIGN + '[metric.miss]\nexpression = "plant.positon[1]"\nreduction = "final"\n',
        "text.fmu": "no zip",
        "notes.txt": "no block",
        "no_block.py": "x = 1\n",
        "syntax.py": "class Mine(\n",
        "no_solve.py": block(base="TerminalGuidance", method="help(self) -> None", body="self.status = 0"),
        "undeclared.py": block("self.gain = self.u"),
        "wrong_size.py": block("self.v = vector(self.u, self.u)"),
        "uses_numpy.py": block("self.y = float(np.sin(self.u))", imports="import numpy as np\n"),
        "no_unit.py": block(declared='    w = Input(0.0, unit="furlong", description="in")\n'),
        "no_words.py": block(declared="    w = Input(0.0)\n"),
        "no_import.py": block("self.y = math.sqrt(self.u)"),
        "no_import_of_ours.py": block("self.y = norm(self.v)"),
        "above.py": block(declared='    w = Parameter(90.0, maximum=14.0, description="in")\n', imports=PARAMETER),
        "below.py": block(declared='    w = Input([1.0, -1.0], minimum=0.0, description="in")\n'),
        "other_causality.py": block(
            base="TerminalGuidance",
            method="solve(self) -> None",
            body="self.status = 0",
            declared='    mass = Parameter(1.0, unit="kg", description="mine")\n',
            imports=PARAMETER,
        ),
        "twice.py": block() + block().partition("import Block")[2].partition("\n")[2],
        "two_cases.py": block().replace("Mine", "AxisMine") + '\n\nclass Axis_Mine(AxisMine):\n    """Two."""\n',
        "here.py": "mine\n",
        "file": "mine",
    }.items():
        Path(name).write_text(text, encoding="utf-8")
    for name, (ours, content, torque) in {
        "stabilty": ("stabilty", "stability", 2),
        "orbit": ("orbit", "orbit", 2),
        "space": ("stability", "stabilty", 2),
        "setting": ("stability", "stability", 2),
        "units": ("stability", "stability", 1),
    }.items():
        Path(name).mkdir()
        Path(name, "SystemStructure.ssd").write_text(SSD.format(ours=ours, content=content, torque=torque))
    Path("folder").mkdir()
    Path("results").mkdir()
    Path("results/summary.json").write_text("{}")
    zipped("empty.ssp", {"readme.txt": "no SSD"})
    zipped("bare.fmu", {"readme.txt": "no description"})
    return tmp_path


def snapshot(folder):
    # Python stores a user's compiled file next to it, as for any import
    actual = [path for path in sorted(folder.rglob("*")) if "__pycache__" not in path.parts]
    return {path.relative_to(folder).as_posix(): path.read_bytes() if path.is_file() else None for path in actual}


CASES = {
    # names
    "a verb with a typo": (["rn", SYSTEM], ["'rn'", "run"]),
    "no verb": ([], ["VERB", "perilune --help"]),
    "a system with a typo": (["run", "lunar_landings"], ["lunar_landings", "nearest of", ": lunar_landing"]),
    "a system that is an FMU": (["run", "astar_guidance"], ["astar_guidance", "neither a system"]),
    "an FMU with a typo": ([*RUN, "--use", "guidance=astar_guidence"], ["--use", "astar_guidence", "astar_guidance"]),
    "the first letters of an FMU": (
        [*RUN, "--use", "guidance=astar"],
        ["guidance=astar: no such FMU", "fit guidance", "astar_guidance, astar_modified_guidance, astar_robust"],
    ),
    "an option with a typo": ([*RUN, "--sett", "x=1"], ["run: ", "--sett", "see perilune run --help"]),
    "an option of design with a typo": (["design", "law", "x", "--no"], ["--no", "see perilune design law --help"]),
    "a campaign as a system": (["run", "mine.toml"], ["a campaign is not a system", "--campaign mine.toml"]),
    "a slot with a typo": ([*RUN, "--use", "guidence=astar_guidance"], ["--use", "guidence", "use one of", "guidance"]),
    "an FMU that does not fit": (
        [*RUN, "--use", "guidance=kalman_navigation"],
        ["--use: guidance=kalman_navigation", "does not fit guidance", "guidance.mass", "these fit: analytic_exact_g"],
    ),
    "--use without =": ([*RUN, "--use", "astar_guidance"], ["--use", "SLOT=FMU", "use this form"]),
    "a slot twice": (
        [*RUN, "--use", "guidance=astar_guidance", "--use", "guidance=analytic_guidance"],
        ["--use", "guidance is given twice", "give each name once"],
    ),
    "a parameter with a typo": (
        [*RUN, "--set", "guidance.gravty=1.6"],
        ["--set", "guidance.gravty", "gravity"],
    ),
    "a component with a typo": ([*RUN, "--set", "gidance.gravity=1.6"], ["--set", "gidance.gravity"]),
    "a parameter set with a typo": ([*RUN, "--parameters", "nosy.ssv"], ["--parameters", "nosy.ssv", "noisy.ssv"]),
    "a campaign with a typo": (["batch", SYSTEM, "--campaign", "papr"], ["--campaign", "papr", "paper.toml"]),
    "a variant that is not there": ([*RUN, "--variant", "other"], ["--variant", "other", "SystemStructure"]),
    "a loop with a typo": (["stability", "robot_rendezvous", "--loop", "atitude"], ["--loop", "atitude", "attitude"]),
    "a law with a typo": (["design", "law", "diveev_2031"], ["diveev_2031", "diveev_2013"]),
    "something to describe with a typo": (
        ["describe", "terminal_guidence"],
        ["terminal_guidence", "terminal_guidance"],
    ),
    "a component to describe with a typo": (["describe", SYSTEM, "plnt"], ["plnt", "plant"]),
    "a fault on no connector": ([*RUN, "--fault", "plant.thrst=freeze@5"], ["fault", "plant.thrst", "plant.thrust"]),
    "a fault of no kind": ([*RUN, "--fault", "plant.thrust=broken@5"], ["--fault", "broken", "override"]),
    "a fault without a time": ([*RUN, "--fault", "plant.thrust=freeze"], ["--fault", "plant.thrust=freeze", "@"]),
    "a requirement on nothing": ([*RUN, "--require", "plant.masss > 0"], ["--require", "plant.masss", "plant.mass"]),
    "a requirement that is no expression": ([*RUN, "--require", "plant.mass >"], ["--require", "plant.mass >"]),
    "a batch's requirement on nothing": ([*BATCH, "--require", "default.rate > 0"], ["--require", "default.rate"]),
    # values
    "a text for a number": ([*RUN, "--set", "plant.initial_mass=heavy"], ["plant.initial_mass", "heavy", "number"]),
    "a fraction for a whole number": (
        [*RUN, "--set", "guidance.terminal_step=0.5"],
        ["guidance.terminal_step", "0.5"],
    ),
    "a number for a truth": ([*RUN, "--set", "guidance.gravity_correction=2"], ["gravity_correction", "true or false"]),
    "beyond the largest": (
        [*RUN, "--set", "guidance.terminal_step=2"],
        ["guidance.terminal_step", "no item 2", "use one of EXACT, STOP"],
    ),
    "below the least": ([*RUN, "--set", "guidance.gravity=-1"], ["guidance.gravity", "-1", "minimum"]),
    "a connected input": (
        [*RUN, "--set", "plant.thrust=5"],
        ["plant.thrust", "connected to allocation.thrust", "--fault plant.thrust=override:5@0"],
    ),
    "an output": ([*RUN, "--set", "plant.mass=5"], ["plant.mass", "output"]),
    "a vector of one": (
        [*RUN, "--set", "guidance.target_position=5"],
        ["guidance.target_position", "1 value for the 3 elements", "[1]"],
    ),
    "a vector cut short": ([*RUN, "--set", "guidance.target_position=0,0"], ["2 values for the 3 elements", "give 3"]),
    "a vector of words": ([*RUN, "--set", "guidance.target_position=0,b,0"], ["guidance.target_position[2]", "'b'"]),
    "a value with its unit": ([*RUN, "--set", "plant.initial_mass=1000kg"], ["'1000kg'", "write a number, in kg"]),
    "samples closer than the step": (
        ["run", "robot_rendezvous", "--set", "attitude_control.sample_period=0.03"],
        ["--set", "attitude_control.sample_period", "0.03 s is shorter than", "0.125 s", "--step of 0.03"],
    ),
    "a draw of a vector that is set": (
        [*BATCH, "--set", "plant.initial_position=0,0,15e3"],
        ["plant.initial_position", "draws"],
    ),
    "a step of nothing": ([*RUN, "--step", "0"], ["--step", "positive"]),
    "a step that is no number": ([*RUN, "--step", "fast"], ["--step", "'fast'", "number of seconds"]),
    "an end between steps": ([*RUN, "--stop-time", "1.05"], ["--stop-time", "1.05", "whole number", "--stop-time 1"]),
    "an end before the start": ([*RUN, "--stop-time", "-1"], ["--stop-time", "-1", "lies before the start, 0 s"]),
    "no trials": ([*BATCH, "--trials", "0"], ["--trials", "0", "1 or more"]),
    "trials that are no number": ([*BATCH, "--trials", "many"], ["--trials", "many"]),
    "no workers": ([*BATCH, "--workers", "0"], ["--workers", "0"]),
    "a trial that is not in the campaign": (
        ["replay", BATCH[1], "5", *BATCH[2:], "--trials", "5", "--configuration", "analytic_guidance"],
        ["trial 5", "no such trial", "0 to 4"],
    ),
    "a comparison of one that is not there": (
        [*BATCH, "--compare", "guidance=analytic_guidance,astar_guidnce"],
        ["--compare: guidance=astar_guidnce", "astar_guidance"],
    ),
    "a draw that is set, too": (
        [*BATCH, "--set", "plant.initial_position[3]=15e3"],
        ["plant.initial_position[3]", "draws"],
    ),
    "a verb that has left": (["benchmark", "--steps", "10"], ["benchmark", "`make bench` in a checkout"]),
    # files
    "a parameter set of no system": ([*RUN, "--parameters", "no_system.ssv"], ["no_system.ssv", "plnt.initial_mass"]),
    "a value in a wrong unit": ([*RUN, "--parameters", "wrong_unit.ssv"], ["wrong_unit.ssv", "unit", "kg"]),
    "a value in an unknown unit": ([*RUN, "--parameters", "unknown_unit.ssv"], ["unknown_unit.ssv", "stone"]),
    "a value that is no number": ([*RUN, "--parameters", "no_number.ssv"], ["no_number.ssv", "heavy"]),
    "XML cut off": ([*RUN, "--parameters", "cut.ssv"], ["cut.ssv", "not well-formed", "line"]),
    "TOML cut off": (["batch", SYSTEM, "--campaign", "cut.toml"], ["cut.toml", "line 1"]),
    "a key with a typo": (["batch", SYSTEM, "--campaign", "key.toml"], ["key.toml", "sucess", "success"]),
    "a distribution that is none": (["batch", SYSTEM, "--campaign", "draw.toml"], ["draw.toml", "gaussian", "normal"]),
    "a metric of no signal": (
        ["batch", SYSTEM, "--campaign", "metric.toml"],
        ["metric.toml", "plant.positon[1]", "plant.position[1]"],
    ),
    "a campaign of another system": (["batch", "lunar_descent_2d", "--campaign", "paper"], ["paper", "table1.toml"]),
    "an FMU that is no zip": ([*RUN, "--use", "guidance=text.fmu"], ["text.fmu", "not a readable zip"]),
    "an FMU without a description": ([*RUN, "--use", "guidance=bare.fmu"], ["bare.fmu", "modelDescription.xml"]),
    "an FMU that is not there": ([*RUN, "--use", "guidance=none.fmu"], ["none.fmu", "no such file"]),
    "an .ssp without an SSD": (["run", "empty.ssp"], ["empty.ssp", "SystemStructure.ssd", "not found"]),
    "a folder without an SSD": (["run", "folder"], ["folder", "SystemStructure.ssd", "not found"]),
    "a file of blocks that is to fly": (
        ["run", "no_block.py"],
        ["no_block.py", "not a system", "perilune export no_bl"],
    ),
    "a file of blocks to validate": (["validate", "no_block.py"], ["no_block.py", "perilune export no_block.py"]),
    "an annotation with a typo": (["run", "stabilty"], ["line 16", "org.perilune.stabilty", ".stability"]),
    "an annotation of ours that is none": (["run", "orbit"], ["org.perilune.orbit", "use one of", ".step"]),
    "an annotation with another content": (["run", "space"], ["Stability (line 17)", "https://perilune.org/stability"]),
    "a point's setting with a typo": (
        ["stability", "setting"],
        ["setting/SystemStructure.ssd", "control.lead_tim (line 19)", "control.lead_time"],
    ),
    "a unit of other base units": (
        ["run", "units"],
        ["control.torque", "N.m (kg m2 s-2)", "N.m (kg m s-2)", "correct the connector's unit"],
    ),
    "a file that is no system": (["run", "notes.txt"], ["notes.txt", "not a readable zip"]),
    "nothing to validate": (["validate", "none.ssp"], ["none.ssp"]),
    "results that are none": (["compare", "folder"], ["folder"]),
    "results that are not there": (["compare", "nowhere"], ["nowhere"]),
    "a law that is no law": (["design", "law", "results/summary.json"], ["summary.json", "format"]),
    # targets
    "a page of another kind": ([*RUN, "--report", "flight.pdf"], ["--report", "flight.pdf", "end the name with .html"]),
    "a study's page of another kind": (["stability", "robot_rendezvous", "--report", "x.pdf"], ["x.pdf", ".html"]),
    "a table of another kind": ([*RUN, "--output", "flight.xlsx"], ["--output", "flight.xlsx", ".csv or .parquet"]),
    "a table that is a folder": ([*RUN, "--output", "folder"], ["--output", "folder", ".csv"]),
    "a page below a file": ([*RUN, "--report", "file/page.html"], ["--report", "is a file", "another folder"]),
    "JSON into a folder": ([*RUN, "--json", "folder"], ["--json", "is a folder"]),
    "a folder with results": ([*BATCH, "--output", "results"], ["--output", "results", "--overwrite"]),
    "a batch into a file": ([*BATCH, "--output", "file"], ["--output", "file is a file"]),
    "a law of another kind": (
        ["design", "law", "diveev_2013", "--output", "law.json"],
        ["--output", "law.json", ".ssv"],
    ),
    "a law below a file": (["design", "law", "diveev_2013", "--output", "file/law.ssv"], ["--output", "is a file"]),
    "a drawing below a file": (["design", "law", "diveev_2013", "--graph", "file/law.svg"], ["--graph", "is a file"]),
    "a law's JSON into a folder": (["design", "law", "diveev_2013", "--json", "folder"], ["--json", "is a folder"]),
    "a search into a file": (
        ["design", "search", "lunar_descent_2d", "--output", "file"],
        ["--output", "file is a file"],
    ),
    "a search over results": (
        ["design", "search", "lunar_descent_2d", "--output", "results"],
        ["--output", "holds results already", "--resume"],
    ),
    "a search's JSON into a folder": (
        ["design", "search", "lunar_descent_2d", "--json", "folder"],
        ["--json", "is a folder"],
    ),
    "a plan's page into a folder": (["design", "transfer", "--report", "folder"], ["--report", "is a folder"]),
    "a plan's JSON below a file": (["design", "bound", "--json", "file/x.json"], ["--json", "is a file"]),
    "a description below a file": (["describe", SYSTEM, "--json", "file/x.json"], ["--json", "is a file"]),
    "a list into a folder": (["list", "--json", "folder"], ["--json", "is a folder"]),
    "a check into a folder": (["validate", SYSTEM, "--json", "folder"], ["--json", "is a folder"]),
    "an FMU of another kind": (["export", "astar_guidance", "--output", "x.zip"], ["--output", "x.zip", ".fmu"]),
    "a system of another kind": (["export", SYSTEM, "--output", "x.fmu"], ["--output", "x.fmu", ".ssp"]),
    "an FMU below a file": (["export", "astar_guidance", "--output", "file/x.fmu"], ["--output", "is a file"]),
    # blocks of one's own
    "a block that is not there": (["export", "none.py"], ["none.py", "give the .py file"]),
    "no block at all": (["export", "no_block.py"], ["no_block.py", "defines no block", "derive a class"]),
    "no Python": (["export", "syntax.py"], ["syntax.py", "SyntaxError"]),
    "a guidance without solve": (["export", "no_solve.py"], ["no_solve.py", "has no solve", "write def solve(self)"]),
    "what is not declared": (["export", "undeclared.py"], ["undeclared.py", "self.gain", "State"]),
    "a vector of another size": (["export", "wrong_size.py"], ["wrong_size.py", "v", "3"]),
    "a library in a kernel": (["export", "uses_numpy.py"], ["uses_numpy.py", "np.sin", "python_only"]),
    "a forgotten import": (["export", "no_import.py"], ["no_import.py:", "math is not imported", "write import math"]),
    "a forgotten import of ours": (["export", "no_import_of_ours.py"], ["norm is not", "from perilune import norm"]),
    "a start above its maximum": (["export", "above.py"], ["Mine.w", "starts at 90.0", "above its maximum 14.0"]),
    "an element below its minimum": (["export", "below.py"], ["Mine.w", "starts at -1.0", "below its minimum 0.0"]),
    "a slot's input as a parameter": (
        ["export", "other_causality.py"],
        ["Mine.mass", "has causality parameter here, but input", "give the variable another name"],
    ),
    "two classes of one name": (["export", "twice.py"], ["lines 6 and", "two classes Mine", "rename one"]),
    "two classes of one FMU": (["export", "two_cases.py"], ["AxisMine and Axis_Mine", "axis_mine", "rename one"]),
    "a file with a typo": (["export", "no_blocks.py"], ["no_blocks.py: no such file", ".py file", "no_block.py"]),
    "something to export that is nothing near": (["export", "f.html"], ["f.html", "and", "more"]),
    "a unit that is none": (["export", "no_unit.py"], ["no_unit.py", "Mine.w", "furlong", "write the unit in m, kg"]),
    "a variable without words": (["export", "no_words.py"], ["no_words.py", "Mine.w", "give a description"]),
    "something to export with a typo": (["export", "astar_guidence"], ["astar_guidence", "astar_guidance"]),
    "a block over a file": (["new", "block", "here"], ["here.py", "not overwritten", "another name"]),
    "a system over a folder": (["new", "system", "folder"], ["folder", "not overwritten", "another name"]),
    "a block of no slot": (["new", "block", "mine", "--slot", "guidance"], ["--slot", "guidance", "terminal_guidance"]),
}


def test_there_are_many():
    assert len(CASES) >= 40


@pytest.mark.parametrize("name", CASES)
def test_a_mistake(name, working, capfd):
    arguments, words = CASES[name]
    before = snapshot(working)
    try:
        status = main(arguments)
    except SystemExit as stop:  # argparse's own
        status = stop.code
    captured = capfd.readouterr()
    assert captured.err.startswith("perilune: "), captured.err
    assert captured.err.count("\n") == 1, captured.err
    for token in words:
        assert token in captured.err, captured.err
    assert status == 2
    assert captured.out == ""
    assert snapshot(working) == before


def test_every_violation_has_a_line_of_its_own(working, capfd):
    Path("worse.py").write_text(block("self.y = math.sqrt(self.u)\n        self.gain = self.u"), encoding="utf-8")
    assert main(["export", "worse.py"]) == 2
    first, second = capfd.readouterr().err.splitlines()
    assert first.startswith("perilune: Mine: ")
    assert "worse.py:14: math is not imported; write import math at the top of the file" in first
    assert "worse.py:15: self.gain" in second
    assert not Path("build").exists()
