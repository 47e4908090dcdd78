"""Campaigns of lunar terminal guidance draw from the published box of initial states. Truth: Fomichev and Li 2017."""

from pathlib import Path

import numpy as np
import pytest
from scipy import stats

from perilune.analysis.campaigns.definition.file import read_campaign
from perilune.analysis.campaigns.draws.table import draw_table
from perilune.fmus_src.catalogue import catalogue

CAMPAIGNS = Path(__file__).parents[3] / "ssp_systems" / "lunar_terminal_guidance" / "campaigns"
NAMES = ("paper", "noisy")
ALPHA = 1e-3


def load(name):
    return read_campaign(CAMPAIGNS / f"{name}.toml")


@pytest.mark.parametrize("name", NAMES)
def test_initial_states_fill_the_published_box(name):
    columns = draw_table(load(name)).columns
    position = np.column_stack([columns[f"plant.initial_position[{i}]"] for i in (1, 2, 3)])
    velocity = np.column_stack([columns[f"plant.initial_velocity[{i}]"] for i in (1, 2, 3)])
    ground_range = np.hypot(position[:, 0], position[:, 1])
    azimuth = np.arctan2(position[:, 1], position[:, 0])
    speed = np.linalg.norm(velocity, axis=1)
    slope = np.arcsin(velocity[:, 2] / speed)
    # heading from the direction to the site, which is opposite to the position: angle between complex numbers
    course = (velocity[:, 0] + 1j * velocity[:, 1]) / -(position[:, 0] + 1j * position[:, 1])
    for values, low, high in (
        (ground_range, 0.95e5, 1.05e5),
        (azimuth, -np.pi / 4, np.pi / 4),
        (position[:, 2], 0.95e4, 1.15e4),
        (speed, 940, 960),
        (slope / np.arctan(position[:, 2] / ground_range), -1, 0),
        (np.angle(course), -np.pi / 18, np.pi / 18),
    ):
        assert stats.kstest(values, stats.uniform(low, high - low).cdf).pvalue > ALPHA


@pytest.mark.parametrize("name", NAMES)
def test_flies_the_published_comparison(name):
    campaign = load(name)
    assert (campaign.trials, campaign.seed, campaign.system) == (2000, 20170700, "lunar_terminal_guidance")
    methods = ["analytic_guidance", "astar_guidance", "astar_modified_guidance"]
    assert [variant.use for variant in campaign.variants()] == [{"guidance": method} for method in methods]
    assert set(methods) <= catalogue().keys()
    limits = {"finished": 1, "position_error": 200, "velocity_error": 10}
    assert campaign.success.evaluate(limits) == 1.0
    for missed in ({"finished": 0}, {"position_error": 200.1}, {"velocity_error": 10.1}):
        assert campaign.success.evaluate(limits | missed) == 0.0


def test_only_the_parameters_differ():
    paper, noisy = load("paper"), load("noisy")
    assert (paper.parameters, noisy.parameters) == ((), ("noisy.ssv",))
    assert (paper.metrics, paper.draws, paper.derived) == (noisy.metrics, noisy.draws, noisy.derived)


@pytest.mark.parametrize("name", NAMES)
def test_every_name_is_a_variable_of_its_block(name):
    campaign = load(name)
    blocks = catalogue()
    known = set()
    for component, block in (("plant", "flat_moon_lander"), ("guidance", "astar_guidance")):
        for variable in blocks[block].variables.values():
            known |= {f"{component}.{element}" for element in variable.element_names()}
    used = {name for metric in campaign.metrics for name in metric.expression.names if "." in name}
    assert used | set(campaign.record.final) | {n for n in campaign.input_names() if "." in n} <= known
