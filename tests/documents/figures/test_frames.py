"""Figures and scenes of a system that declares names for the axes of its frames.

Truth: the names as declared.
"""

from __future__ import annotations

import shutil

import pytest

from perilune.analysis.documents.figures.figure_reader import read_figures
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from perilune.common.paths import SYSTEMS
from tests.support.pages.declaring import shipped_ssd, with_report

pytestmark = pytest.mark.usefixtures("fmus")
NAME = "lunar_terminal_guidance"
FRAMES = '<Frame name="landing site" axes="north west up"/>'
AXES = ("north", "west", "up")
BODY = '<Body name="lander" shape="lander" size="3 3 2" position="plant.position"/>'


@pytest.fixture(scope="module")
def loaded():
    """Return the FMUs of the system, loaded once."""
    return {}


@pytest.fixture
def read(tmp_path, loaded):
    """Read the figures of a system with this in its report, and these frames."""

    def read_report(inside, frames=FRAMES):
        folder = tmp_path / NAME
        if not folder.exists():
            shutil.copytree(SYSTEMS / NAME, folder)
        text = with_report(shipped_ssd(NAME), inside, frames)
        (folder / "SystemStructure.ssd").write_text(text, encoding="utf-8")
        return read_figures(prepare_system(folder, SystemOptions(), loaded))

    return read_report


def test_elements_are_called_by_their_axes(read):
    band, labelled, error, curve, path = read(
        '<Band signal="plant.position" low="0" against="plant.velocity[3]"/>'
        '<Band signal="plant.position" low="0" labels="x y z"/>'
        '<Error estimate="plant.position[3]" truth="plant.position[2]"/>'
        '<Curve signals="plant.velocity[1] plant.velocity[3]"/>'
        '<Path x="plant.position[1]" y="plant.position[3]"/>'
    )
    assert (band.title, band.labels, band.line_names) == ("plant.position", AXES, AXES)
    assert [each.label for each in band.against] == ["plant.velocity up"]
    assert labelled.labels == ("x", "y", "z")
    assert (error.labels, error.estimate.label, error.estimate.names) == (
        ("",), "plant.position up", ("plant.position[3]",),
    )  # fmt: skip
    assert curve.labels == ("plant.velocity north", "plant.velocity up")
    assert path.title == "plant.position up over plant.position north"


def test_without_frames_elements_are_called_by_their_index(read):
    (band,) = read('<Band signal="plant.position" low="0" against="plant.velocity[3]"/>', "")
    assert (band.labels, band.against[0].label) == (("[1]", "[2]", "[3]"), "plant.velocity[3]")


def test_a_scene_has_the_axes_of_its_frame(read):
    assert read(f'<Scene frame="landing site">{BODY}</Scene>')[0].axes == AXES
    assert read(f'<Scene frame="orbital" axes="a b c">{BODY}</Scene>')[0].axes == ("a", "b", "c")
    assert read(f"<Scene>{BODY}</Scene>")[0].axes == ("x", "y", "z")
    assert read(f'<Scene frame="anything">{BODY}</Scene>', "")[0].axes == ("x", "y", "z")


@pytest.mark.parametrize(
    ("attributes", "problem"),
    [
        ('frame="landing site" axes="a b c"', "Frame landing site also declares axes; leave out axes here"),
        ('frame="landing sight"', "frame landing sight: no such Frame; use one of landing site"),
    ],
)
def test_a_scene_in_no_frame_or_with_further_axes_is_refused(read, attributes, problem):
    with pytest.raises(InputError, match=rf"Scene \(line \d+\): {problem}"):
        read(f"<Scene {attributes}>{BODY}</Scene>")
