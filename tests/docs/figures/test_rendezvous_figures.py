"""Figures of docs/systems/robot_rendezvous.md: reproduced, labelled, small, and used by the text."""

import re

import numpy as np
import pytest
from lxml import etree

from docs.figures.rendezvous_figures import draw_rendezvous_figures, fly, gyros_figure, momentum_figure, turn_figure
from perilune.common.paths import ROOT

LABELS = {
    "scene": {"x, m", "y, m", "z, m", "robot", "object"},
    "turn": {"time, s", "Rodrigues parameters", "angular velocity, deg/s", "size", "size, least time"},
    "plan": {"time, s", "relative position, m", "relative velocity, m/s", "acceleration, µm/s²", "size"},
    "momentum": {"momentum x", "momentum y", "momentum z", "region", "regular within", "turn"},
    "range": {"time, s", "range, m", "range error, mm", "position error, mm"},
    "thrust": {"time, s"} | {f"force on body axis {axis}, N" for axis in "xyz"},
    "gyros": {"time, s", "gimbal angle, deg"},
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


@pytest.mark.slow
def test_labels_and_stored_figures_are_those_of_the_page(drawn_once):
    assert {path.stem for path in drawn_once} == set(LABELS)
    for first in drawn_once:
        sampled = first.read_bytes()
        assert len(sampled) < 100_000
        assert b"<dc:date>" not in sampled
        root, retained = (
            etree.fromstring(sampled),
            etree.parse(ROOT / "docs" / "images" / "rendezvous" / first.name).getroot(),
        )
        texts = {comment.text.strip() for comment in root.iter(etree.Comment)}  # text is drawn as paths
        assert texts >= LABELS[first.stem]
        assert retained.get("viewBox") == root.get("viewBox")
        assert [group.get("id") for group in retained.iter("{*}g")] == [group.get("id") for group in root.iter("{*}g")]


def test_the_text_shows_each_figure_once():
    text = (ROOT / "docs" / "systems" / "robot_rendezvous.md").read_text(encoding="utf-8")
    assert sorted(re.findall(r"\(../images/rendezvous/(\w+)\.svg\)", text)) == sorted(LABELS)


def test_gimbals_are_drawn_from_the_isotropic_angles_and_back(flight):
    isotropic = np.degrees(np.arccos(np.sqrt(2.0 / 3.0)))  # docs/systems/robot_rendezvous.md, Gyros
    expected = np.array([isotropic, -isotropic, 180.0 + isotropic, 180.0 - isotropic])
    sampled = [line.get_ydata() for line in gyros_figure(flight).axes[0].get_lines() if len(line.get_ydata()) > 2]
    assert [angles[0] for angles in sampled] == pytest.approx(expected, abs=1e-9)
    assert [angles[-1] for angles in sampled] == pytest.approx(expected, abs=0.01)


def test_the_region_of_momentum_is_that_of_all_gimbal_angles(flight):
    """Random angles of four gyros, by the definition of the cluster: within the outlines, and up to them."""
    c, s = (f(np.random.default_rng(1).uniform(-np.pi, np.pi, (4, 200_000))) for f in (np.cos, np.sin))
    momentum = np.stack([c.sum(axis=0), s[0] + s[1], s[2] + s[3]])
    for axes, (first, second) in zip(momentum_figure(flight).axes[1:], ((0, 1), (0, 2), (1, 2)), strict=True):
        outline, _, turn = (np.array(line.get_data()) for line in axes.get_lines())
        for angle in np.linspace(0.0, np.pi, 7):
            direction = np.array([np.cos(angle), np.sin(angle)])
            largest = (direction @ outline).max()
            reached = (direction @ momentum[[first, second]]).max()
            assert 0.9 * largest < reached <= largest + 1e-12
            assert np.abs(direction @ turn).max() < 1.0


def test_both_turns_end_alike_and_the_dashed_one_is_slower_at_its_fastest(flight):
    attitude, rate, acceleration = (
        {line.get_label(): line.get_ydata() for line in axes.get_lines()} for axes in turn_figure(flight).axes
    )
    for number in (0, -1):
        assert attitude["size, least time"][number] == pytest.approx(attitude["size"][number], abs=1e-12)
    assert rate["size, least time"].max() == pytest.approx(np.degrees(0.03), rel=1e-12)
    assert rate["size"].max() == pytest.approx(np.degrees(0.0461292), rel=1e-4)
    assert acceleration["size, least time"].max() < acceleration["size"].max()
