"""The figures of docs/systems/robot_rendezvous.md: reproduced, labelled, small, and those that the text shows."""

import re

import numpy as np
import pytest
from lxml import etree

from docs.figures.rendezvous_figures import draw_rendezvous_figures, fly, gyros_figure
from perilune.fmus_src.paths import ROOT

LABELS = {
    "rendezvous_scene": {"x, m", "y, m", "z, m", "robot", "object"},
    "rendezvous_range": {"time, s", "range, m", "range error, mm", "position error, mm"},
    "rendezvous_thrust": {"time, s"} | {f"force on body axis {axis}, N" for axis in "xyz"},
    "rendezvous_gyros": {"time, s", "gimbal angle, deg"},
}


@pytest.fixture(scope="module")
def flight(fmus):
    return fly()


@pytest.fixture(scope="module")
def drawn_once(flight, tmp_path_factory):
    return draw_rendezvous_figures(flight, tmp_path_factory.mktemp("figures"))


@pytest.mark.slow
def test_bytes_repeat(flight, drawn_once, tmp_path):
    for first, second in zip(drawn_once, draw_rendezvous_figures(flight, tmp_path), strict=True):
        assert first.read_bytes() == second.read_bytes()


def test_labels_are_there_and_the_kept_ones_are_these(drawn_once):
    assert {path.stem for path in drawn_once} == set(LABELS)
    for first in drawn_once:
        sampled = first.read_bytes()
        assert len(sampled) < 100_000
        assert b"<dc:date>" not in sampled
        root, retained = etree.fromstring(sampled), etree.parse(ROOT / "docs" / "images" / first.name).getroot()
        texts = {comment.text.strip() for comment in root.iter(etree.Comment)}  # text is drawn as paths
        assert texts >= LABELS[first.stem]
        assert retained.get("viewBox") == root.get("viewBox")
        assert [group.get("id") for group in retained.iter("{*}g")] == [group.get("id") for group in root.iter("{*}g")]


def test_the_text_shows_each_figure_once():
    text = (ROOT / "docs" / "systems" / "robot_rendezvous.md").read_text(encoding="utf-8")
    assert sorted(re.findall(r"\(../images/(\w+)\.svg\)", text)) == sorted(LABELS)


def test_gimbals_are_drawn_from_the_isotropic_angles_and_back(flight):
    isotropic = np.degrees(np.arccos(np.sqrt(2.0 / 3.0)))  # docs/systems/robot_rendezvous.md, Gyros
    expected = np.array([isotropic, -isotropic, 180.0 + isotropic, 180.0 - isotropic])
    sampled = [line.get_ydata() for line in gyros_figure(flight).axes[0].get_lines() if len(line.get_ydata()) > 2]
    assert [angles[0] for angles in sampled] == pytest.approx(expected, abs=1e-9)
    assert [angles[-1] for angles in sampled] == pytest.approx(expected, abs=0.01)
