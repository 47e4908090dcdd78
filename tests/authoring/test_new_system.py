"""`perilune new system`: the template builds, runs, and has the margins that follow from its equations.

Truth: python-control on the rigid body behind a zero-order hold with sampled control; scipy's integrator with the law
written here; equality of the flavours, bit by bit; ruff with the product's settings.
"""

import json
from pathlib import Path

import control
import numpy as np
import pytest
from lxml import etree
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import perilune
from perilune.analysis.cli import main
from perilune.analysis.documents.figures.scene.scene_elements import SceneFigure
from perilune.analysis.documents.scene.poses import compute_poses
from perilune.common.paths import FLAVOURS, ROOT
from tests.support.loops.exact_margins import crossings, disk_margin
from tests.support.own_style import assert_in_style

NAME = "mine"
INERTIA, DISTURBANCE, START = 500.0, 0.01, np.radians(5.0)
PERIOD, KP, KI, KD = 0.5, 6.6, 0.1, 90.0


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return a working folder with the system in it, its FMUs built in both flavours."""
    path = tmp_path_factory.mktemp("working")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(path)
        assert main(["new", "system", NAME]) == 0
        assert main(["export", f"{NAME}/blocks.py"]) == 0
    return path


@pytest.fixture(autouse=True)
def in_it(request, monkeypatch):
    if "folder" in request.fixturenames:
        monkeypatch.chdir(request.getfixturevalue("folder"))


def test_its_scene_is_that_of_the_docs(folder):
    text = Path(NAME, "SystemStructure.ssd").read_text(encoding="utf-8")
    begin, end = text.index("        <Scene"), text.index("</Scene>\n") + len("</Scene>\n")
    assert text[begin:end].count("\n") <= 10
    assert f"```xml\n{text[begin:end]}```" in Path(ROOT, "docs", "reports.md").read_text(encoding="utf-8")
    result = perilune.simulate(NAME)
    (scene,) = (figure for figure in result.figures if isinstance(figure, SceneFigure))
    (pose,) = compute_poses(scene, result)
    expected = Rotation.from_euler("z", result["plant.angle"][:, None]).as_matrix()
    assert abs(Rotation.from_quat(pose.attitude.T, scalar_first=True).as_matrix() - expected).max() < 1e-12


def flown_here():
    """Return angles at the communication points of 0.1 s."""
    motion, summed, torque, angles = np.array([START, 0.0]), 0.0, 0.0, [START]
    for cycle in range(800):
        summed += PERIOD * motion[0] if cycle else 0.0
        torque = -KP * motion[0] - KI * summed - KD * motion[1]
        assert abs(torque) < 1.0
        turned = solve_ivp(
            lambda _, y, held=torque: (y[1], (held + DISTURBANCE) / INERTIA),
            (0.0, PERIOD),
            motion,
            rtol=1e-12,
            atol=1e-15,
            t_eval=0.1 * np.arange(1, 6),
        )
        angles += list(turned.y[0])
        motion = turned.y[:, -1]
    return np.array(angles)


def open_loop():
    """Return minus the transfer around control.torque, sampled."""
    plant = control.ss([[0.0, 1.0], [0.0, 0.0]], [[0.0], [1.0 / INERTIA]], np.eye(2), np.zeros((2, 1)))
    # the sum takes the angle of the same instant: ki T z/(z - 1) = ki T (1 + 1/(z - 1))
    law = control.ss(1.0, [[1.0, 0.0]], KI * PERIOD, [[KP + KI * PERIOD, KD]], PERIOD)
    return law * control.c2d(plant, PERIOD, "zoh")


def test_it_flies_as_its_equations_do(folder):
    flights = {flavour: perilune.simulate(NAME, flavour=flavour) for flavour in FLAVOURS}
    assert {flight.status for flight in flights.values()} == {"stop_time"}
    expected = flown_here()
    assert abs(flights["native"]["plant.angle"] - expected).max() < 1e-12
    for name, values in flights["native"].signals.items():
        assert (values == flights["python"][name]).all(), name


def test_its_margins_are_those_of_its_equations(folder):
    report = perilune.stability(NAME)
    (loop,) = report.loops
    gain, phase, _ = crossings(open_loop())
    assert loop.margins.gain == pytest.approx(gain[np.argmin(abs(np.log(gain)))], rel=1e-4)
    assert loop.margins.phase == pytest.approx(min(abs(phase)), rel=1e-4)
    assert loop.robust.disk_margin == pytest.approx(disk_margin(open_loop()), rel=1e-5)
    assert loop.agreement.agrees
    assert report.verdict == "pass"


@pytest.mark.usefixtures("folder")
def test_the_commands_that_it_names(capsys):
    assert main(["run", NAME, "--parameters", "heavy.ssv", "--report", "page.html"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.rpartition(": ")[2] for line in lines[1:3]] == ["PASS, tightest", "PASS"]
    page = Path("page.html").read_text(encoding="utf-8")
    assert "Torque" in page
    assert "Settling time" in page
    require = ["--require", "default.success_rate == 1"]
    assert main(["batch", NAME, "--campaign", "dispersed", "--trials", "20", "--output", "results", *require]) == 0
    assert main(["validate", NAME, f"{NAME}/heavy.ssv", f"{NAME}/campaigns/dispersed.toml"]) == 0
    assert main(["export", NAME]) == 0
    assert main(["validate", f"{NAME}.ssp"]) == 0


@pytest.mark.usefixtures("folder")
def test_its_short_file_is_what_flies():
    before = Path(NAME, "SystemStructure.ssd").read_bytes()
    assert main(["compose", f"{NAME}/system.toml"]) == 0
    assert Path(NAME, "SystemStructure.ssd").read_bytes() == before


@pytest.mark.usefixtures("folder")
def test_connectors_are_all_that_the_blocks_declare():
    spaces = {"ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription"}
    root = etree.parse(f"{NAME}/SystemStructure.ssd").getroot()
    for component in root.iterfind(".//ssd:Component", spaces):
        fmu = Path("build/fmus/python", component.get("source").partition("/")[2])
        described = json.loads(_described(fmu))["variables"]
        expected = {row["name"] for row in described if row["causality"] in ("input", "output")}
        assert {item.get("name") for item in component.iterfind(".//ssd:Connector", spaces)} == expected


def _described(fmu):
    assert main(["describe", str(fmu), "--json", "described.json"]) == 0
    return Path("described.json").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["a", "an_axis_of_a_spacecraft_that_has_a_long_name"])
def test_its_python_is_as_ruff_writes_it(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "system", name]) == 0
    assert main(["new", "block", f"{name}_block"]) == 0
    assert_in_style(tmp_path)
