"""Output of `perilune run` on the end of each system's simulation: distances, speeds, errors and published limits.

Truth: the same numbers computed here from the last values of the signals; the pages of the systems, line by line.
"""

from __future__ import annotations

import math
import re

import pytest
from lxml import html

import perilune
from perilune.analysis.cli import main
from perilune.analysis.documents.figures.declared import LimitsFigure
from perilune.analysis.documents.figures.figure_reader import read_figures
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.paths import ROOT
from tests.support.lengths import either

pytestmark = pytest.mark.usefixtures("fmus")


def vector(final, name):
    return [final[f"{name}[{place}]"] for place in (1, 2, 3)]


def largest(values):
    return max(abs(value) for value in values)


def target(height):
    return lambda final: math.dist(vector(final, "plant.position"), [0.0, 0.0, height])


TRUTH = {
    "lunar_terminal_guidance": [target(2000.0), lambda final: math.hypot(*vector(final, "plant.velocity"))],
    "lunar_landing": [
        lambda final: math.dist(vector(final, "plant.position"), [0.0, 0.0, -1.7374e6]) - 1.7374e6,
        lambda final: math.hypot(*vector(final, "plant.velocity")),
        target(1500.0),
    ],
    "lunar_descent_2d": [lambda final: final["plant.altitude"], lambda final: final["plant.speed"]],
    "robot_rendezvous": [
        lambda final: (
            math.dist(vector(final, "robot.position"), vector(final, "target.position"))
            - math.hypot(*vector(final, "guidance.planned_relative_position"))
        ),
        lambda final: largest(vector(final, "monitor.position_error")),
        lambda final: largest(vector(final, "monitor.attitude_error")) * 648000.0 / math.pi,
    ],
    "satellite_pointing": [
        lambda final: final["monitor.pointing_error"] * 648000.0 / math.pi,
        lambda final: math.hypot(*vector(final, "satellite.angular_velocity")) * 648000.0 / math.pi,
        lambda final: largest([final[f"satellite.wheel_speeds[{k}]"] for k in (1, 2, 3, 4)]) * 30.0 / math.pi,
    ],
    "orbital_attitude": [
        lambda final: math.degrees(largest(vector(final, "plant.angles"))),
        lambda final: math.degrees(
            largest([a - b for a, b in zip(vector(final, "plant.angular_velocity"), (0, 0, -0.0011), strict=True)])
        ),
    ],
}


def tightest_of(lines):
    """Return the line whose value has the least distance from its limits, by the numbers that are displayed."""

    def reserve(line):
        value, *limits = map(float, re.findall(r"(?<=[ (])-?\d[\d.e-]*", line.replace("\N{MINUS SIGN}", "-")))
        low, high = limits if len(limits) == 2 else (-limits[0], limits[0])
        return min(value - low, high - value) / (high - low)

    return min(lines, key=reserve)


@pytest.mark.parametrize("name", either([*TRUTH], [*TRUTH][:2]))
def test_the_limits_of_a_system(name, capsys):
    assert main(["run", name]) == 0
    said = capsys.readouterr().out.splitlines()[1:]
    page = (ROOT / "docs" / "systems" / f"{name}.md").read_text(encoding="utf-8")
    assert "".join(f"    {line}\n" for line in said) in page
    final = perilune.simulate(name).final()
    limits = [line for line in said if ".status: " not in line]
    for line, truth in zip(limits, TRUTH[name], strict=True):
        displayed = re.search(r" (\S*\d\S*)", line).group(1).replace("\N{MINUS SIGN}", "-")
        assert float(displayed) == pytest.approx(truth(final), rel=1e-3), line
        assert line.endswith((": PASS", ": PASS, tightest"))
    assert [line.endswith("tightest") for line in limits] == [each is tightest_of(limits) for each in limits]


def test_what_is_subtracted_follows_the_parameters_that_fly():
    name, moved = "lunar_terminal_guidance", {"guidance.target_position[3]": 1990.0}
    flight = perilune.simulate(name)
    for changes, height in (({}, 2000.0), (moved, 1990.0)):
        prepared = prepare_system(name, SystemOptions(set=changes))
        (limits,) = [figure for figure in read_figures(prepared) if isinstance(figure, LimitsFigure)]
        assert limits.limits[0].value(flight) == pytest.approx(target(height)(flight.final()), rel=1e-12)


@pytest.mark.parametrize(
    ("options", "status", "words"),
    [
        ([], "status", "2 of 2 limits met."),
        (["--set", "guidance.target_position[3]=900", "--stop-time", "60"], "status bad", "2 of 2 limits violated: "),
    ],
)
def test_the_head_of_the_page_says_whether_limits_are_met(tmp_path, capsys, options, status, words):
    page = tmp_path / "flight.html"
    assert main(["run", "lunar_terminal_guidance", *options, "--report", str(page)]) == (0 if status == "status" else 1)
    capsys.readouterr()
    head = html.parse(str(page)).find(".//header").find("div[@class]")
    assert head.get("class") == status
    assert words in head.text_content()
