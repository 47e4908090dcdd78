"""The six blocks of docs/write_a_system.md: composed, validated and simulated, also from Python.

Truth: the angular momentum of body and wheels, which is conserved, with scipy's rotations; the target.
"""

from __future__ import annotations

import re

import numpy as np
import pytest
from lxml import etree
from scipy.spatial.transform import Rotation

import perilune
from perilune.analysis.cli import main
from tests.support.pages.system_page import EXAMPLES, PAGE, SHORT, SSD, write_system

pytestmark = pytest.mark.usefixtures("fmus")
NAME = "holding"
INERTIA = np.array([[180.0, -4.0, 2.0], [-4.0, 150.0, 3.0], [2.0, 3.0, 120.0]])  # kg m2, the FMU's


def momentum(flight):
    """Return angular momentum of body and wheels in inertial axes, N m s, [n, 3]."""
    body = flight["satellite.angular_velocity"] @ INERTIA + flight["satellite.wheel_momentum"]
    return Rotation.from_quat(flight["satellite.quaternion"], scalar_first=True).apply(body)


def angle(flight):
    """Return the turn from the target attitude at the end, rad."""
    return Rotation.from_quat(flight["satellite.quaternion"][-1], scalar_first=True).magnitude()


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_system(tmp_path)
    return tmp_path


def test_the_short_file_flies(here, capsys):
    assert (here / SHORT).read_text(encoding="utf-8").count("\n") <= 30
    assert main(["compose", SHORT]) == 0
    assert capsys.readouterr().out == f"{NAME}/{SSD}\n"
    assert main(["validate", NAME]) == 0
    root = etree.parse(here / NAME / SSD).getroot()
    connectors, connections = (len(root.findall(f".//{{*}}{each}")) for each in ("Connector", "Connection"))
    assert f"{connectors} connectors and {connections} connections" in PAGE
    flight = perilune.simulate(NAME)
    assert angle(flight) < 1e-3 < 0.2
    assert abs(momentum(flight) - momentum(flight)[0]).max() < 1e-9


def test_the_python_of_the_page_flies(here):
    (code,) = [text for kind, text in EXAMPLES if kind == "python" and "perilune.System" in text]
    names = {"perilune": perilune}
    exec(code, names)
    flight = names["flight"]
    assert angle(flight) < 1e-9
    assert abs(momentum(flight) - momentum(flight)[0]).max() < 1e-9
    written = perilune.simulate(here / "ideal_holding")
    assert all((written[name] == values).all() for name, values in flight.signals.items())
    assert (here / "ideal_holding/system.toml").read_text(encoding="utf-8") == names["system"].toml
    assert perilune.compose("ideal_holding").source.set == {"satellite.initial_quaternion": [0.99, 0.1, 0.0, 0.1]}


def test_an_edited_file_is_not_written_over(here, refusal):
    ssd = here / NAME / SSD
    assert main(["compose", SHORT]) == main(["compose", SHORT]) == 0  # unedited
    for change in (('stopTime="200"', 'stopTime="100"'), (re.search("<!--.*-->\n", ssd.read_text())[0], "")):
        text = ssd.read_text(encoding="utf-8").replace(*change)
        ssd.write_text(text, encoding="utf-8")
        assert "and is not overwritten" in refusal(["compose", SHORT])
        assert ssd.read_text(encoding="utf-8") == text
    assert "already exists" in refusal(["compose", NAME, "--output", SHORT])


def test_an_edited_folder_is_not_written_over(here):
    system = perilune.System(NAME, step=0.1, stop_time=1.0)
    system.add("lone", "slew_bang_coast")
    with pytest.raises(perilune.InputError, match="not connected"):
        system.run()
    with pytest.raises(perilune.InputError, match="two components have this name"):
        system.add("lone", "slew_bang_coast")
    system.leave_unconnected("lone.estimated_quaternion")
    with pytest.raises(perilune.InputError, match="edited since perilune compose read it"):
        system.write(here / NAME)
    assert system.write(here / "other")
    system.set("lone.sample_period", 0.2)
    assert system.write(here / "other")  # its own files
    with (here / "other/system.toml").open("a", encoding="utf-8") as file:
        file.write("# mine\n")
    with pytest.raises(perilune.InputError, match="edited since perilune compose read it"):
        system.write(here / "other")


def test_inputs_of_the_system_are_driven_over_time(here):
    """A ramp that goes through an input of the system, whose elements and unit are those of the component."""
    system = perilune.System("ramp", step=0.125, stop_time=1.0)
    system.add("gyros", "rate_gyros")
    system.connector("rate", "input")
    system.connect("rate", "gyros.angular_velocity")
    flight = system.run(input={"time": [0.0, 1.0], **{f"rate[{k}]": [0.0, 0.1 * k] for k in (1, 2, 3)}})
    expected = flight.time[:, None] * [0.1, 0.2, 0.3]
    assert abs(flight["gyros.angular_velocity"] - expected).max() < 1e-15
    assert flight.prepared.network.unit_of("rate[1]").name == "rad/s"


def test_a_matrix_by_rows_is_that_of_its_elements(here):
    toml = here / SHORT
    text, written = toml.read_text(encoding="utf-8"), []
    for axes in ("[1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1]", "[[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]"):
        toml.write_text(f'{text}"satellite.wheel_axes" = {axes}\n', encoding="utf-8")
        assert main(["compose", SHORT]) == 0
        written.append((here / NAME / SSD).read_bytes().partition(b"-->")[2])
    assert written[0] == written[1]
    assert b'name="satellite.wheel_axes[4,1]"' in written[0]
    assert perilune.compose(toml).toml
