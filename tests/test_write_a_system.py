"""System of docs/write_a_system.md, simulated as on the page, and errors in it.

Truth: scipy's integrator with the law written here; python-control on the mass behind a hold; the page, word by word.
"""

from __future__ import annotations

import re
from pathlib import Path

import control
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import perilune
from docs.reference.formats.pages import format_pages
from perilune.analysis.cli import main
from tests.support.loops.exact_margins import crossings, disk_margin
from tests.support.pages.system_page import MISTAKES, PAGE, SSD, write_system

pytestmark = pytest.mark.usefixtures("fmus")
NAME, PERIOD, FREQUENCY, DAMPING = "descent", 0.2, 0.08, 0.9


@pytest.fixture(scope="module")
def working(tmp_path_factory):
    """Write a working folder with the page's files, and their FMUs."""
    folder = tmp_path_factory.mktemp("page")
    write_system(folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        assert main(["export", f"{NAME}/blocks.py"]) == 0
    return folder


@pytest.fixture
def here(working, monkeypatch):
    monkeypatch.chdir(working)
    write_system(working)
    return working


def test_it_flies_as_its_equations_do(here):
    flight = perilune.simulate(NAME)
    assert flight.status == "finished"
    assert (flight["plant.altitude"] == perilune.simulate(NAME, flavour="python")["plant.altitude"]).all()
    motion, altitudes = np.array([1600.0, -2.0]), [1600.0]
    while len(altitudes) < flight.time.size:
        held = -(FREQUENCY**2) * (motion[0] - 1500.0) - 2.0 * DAMPING * FREQUENCY * motion[1]
        turned = solve_ivp(
            lambda _, y, held=held: (y[1], held), (0.0, PERIOD), motion, rtol=1e-12, atol=1e-12, t_eval=(0.1, PERIOD)
        )
        altitudes += list(turned.y[0])
        motion = turned.y[:, -1]
    assert abs(flight["plant.altitude"] - altitudes[: flight.time.size]).max() < 1e-8
    # handed over at the first point below 0.5 m/s in the band
    slow = (flight["plant.speed"] < 0.5) & (abs(flight["plant.altitude"] - 1500.0) <= 10.0)
    assert np.flatnonzero(slow).tolist() == [flight.time.size - 1]


def test_its_margins_are_those_of_its_equations(here):
    (loop,) = perilune.stability(NAME).loops
    gains = control.ss([], [], [], [[FREQUENCY**2, 2.0 * DAMPING * FREQUENCY]], PERIOD)
    mass = control.ss([[0.0, 1.0], [0.0, 0.0]], [[0.0], [1.0]], np.eye(2), np.zeros((2, 1)))
    exact = gains * control.c2d(mass, PERIOD, "zoh")
    gain, phase, _ = crossings(exact)
    assert loop.margins.gain == pytest.approx(gain[np.argmin(abs(np.log(gain)))], rel=1e-4)
    assert loop.margins.phase == pytest.approx(min(abs(phase)), rel=1e-4)
    assert loop.robust.disk_margin == pytest.approx(disk_margin(exact), rel=1e-5)


def test_what_the_page_says_is_printed(here, capsys):
    for arguments in (["run", NAME], ["stability", NAME]):
        assert main(arguments) == 0
        printed = capsys.readouterr().out.splitlines()
        first = printed[0] if arguments[0] == "stability" else printed
        for line in [first] if isinstance(first, str) else first:
            assert f"    {line}\n" in PAGE
    require = ["--require", "default.success_rate == 0.99"]
    assert main(["batch", NAME, "--campaign", "dispersed", *require]) == 0
    assert "99 of 100 trials succeed" in PAGE


def test_an_fmu_from_elsewhere(here):
    flight = perilune.simulate(NAME)
    (here / NAME / "resources").mkdir()
    built = here / "build/fmus/python/vertical_lander.fmu"
    (here / NAME / "resources/engine.fmu").write_bytes(built.read_bytes())
    ssd = here / NAME / SSD
    ssd.write_text(ssd.read_text(encoding="utf-8").replace("vertical_lander.fmu", "engine.fmu"), encoding="utf-8")
    for other in (perilune.simulate(NAME), perilune.simulate(NAME, use={"plant": str(built)})):
        assert (other["plant.altitude"] == flight["plant.altitude"]).all()


MESSAGES = format_pages()["system.md"].partition("## Messages\n")[2]
TABLE = dict(re.findall(r"^\| ([^|]+) \| `(.+)` \|$", MESSAGES, re.MULTILINE))


def test_the_table_has_all_mistakes():
    assert set(TABLE) == set(MISTAKES)


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_has_the_message_of_the_page(here, capsys, mistake):
    name, right, wrong = MISTAKES[mistake]
    path = Path(NAME, name)
    text = path.read_text(encoding="utf-8")
    assert right in text
    path.write_text(text.replace(right, wrong, 1), encoding="utf-8")
    assert main(["validate", NAME]) == 2
    message = capsys.readouterr().err
    assert message.count("\n") == 1
    for part in TABLE[mistake].split("..."):
        assert part.strip(" ,") in message, message
