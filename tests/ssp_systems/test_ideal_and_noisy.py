"""ideal.ssv and noisy.ssv have the same meaning in every system: no random errors, and all random errors.

Truth: a simulation without random errors does not depend on its seeds, to the last bit, and a simulation with random
errors does; the set applied last wins. docs/command_line.md states the rule and the default of each system.
"""

import re

import numpy as np
import pytest

import perilune
from perilune.analysis.campaigns.definition.plan import with_streams
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.paths import ROOT, SYSTEMS
from tests.support.lengths import either

pytestmark = pytest.mark.usefixtures("fmus")
DEFAULTS = {
    "earth_pointing": "noisy",
    "entry_attitude": "noisy",
    "hover_transfer": "noisy",
    "landing_mission": "noisy",
    "lunar_descent_2d": "ideal",
    "lunar_landing": "noisy",
    "lunar_terminal_guidance": "ideal",
    "orbital_attitude": "ideal",
    "robot_rendezvous": "noisy",
    "satellite_pointing": "noisy",
}
EXACT = "flexible_slew"  # has no random errors, and so neither set
STOP = 3.0  # s: every sensor has been sampled twice
# What is known at the start belongs to the start, and this system has ten: its noisy.ssv leaves it as it is.
FIRST = {"landing_mission": {"navigation.first_position_sigma": 100, "navigation.first_velocity_sigma": 0.1}}


def flight(system, *sets, seed=1, **values):
    """Return all signals of a short flight with parameter sets, in their order, and a seed for every source of
    noise."""
    sources = with_streams(prepare_system(system))
    result = perilune.simulate(
        system,
        parameters=[f"{name}.ssv" for name in sets],
        set={f"{name}.seed": seed for name in sources} | values,
        stop_time=STOP,
    )
    return result.signals


def same(first, second):
    assert first.keys() == second.keys()
    return all(np.array_equal(first[name], second[name], equal_nan=True) for name in first)


def test_every_system_is_in_the_table():
    assert sorted([*DEFAULTS, EXACT]) == sorted(path.parent.name for path in SYSTEMS.glob("*/system.toml"))


def test_a_system_without_either_set_does_not_depend_on_seeds():
    assert same(flight(EXACT), flight(EXACT, seed=2))


@pytest.mark.parametrize("system", either(list(DEFAULTS), ["orbital_attitude"]))
def test_no_random_errors_and_all_of_them(system):
    default, other = DEFAULTS[system], {"ideal": "noisy", "noisy": "ideal"}[DEFAULTS[system]]
    flown = {name: flight(system, name) for name in (default, other)}
    assert same(flown["ideal"], flight(system, "ideal", seed=2))
    assert not same(flown["noisy"], flight(system, "noisy", seed=2))
    assert same(flown[default], flight(system))
    assert same(flown["ideal"], flight(system, "noisy", "ideal"))
    assert same(flown["noisy"], flight(system, "ideal", "noisy", **FIRST.get(system, {})))


def test_the_documents_state_the_defaults():
    page = (ROOT / "docs" / "command_line.md").read_text(encoding="utf-8")
    ((usual, systems, other),) = re.findall(
        r"Default values equal `(\w+)\.ssv`; only in (.*) they equal `(\w+)\.ssv`\.", page
    )
    assert dict.fromkeys(DEFAULTS, usual) | dict.fromkeys(re.findall(r"`(\w+)`", systems), other) == DEFAULTS
    for system, default in DEFAULTS.items():
        readme = (SYSTEMS / system / "README.md").read_text(encoding="utf-8")
        assert f"- Default: `{default}.ssv`" in readme
