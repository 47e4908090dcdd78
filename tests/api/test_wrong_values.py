"""Values of the wrong type in Python: one line that names the option and the expected form.

Truth: texts for the command line, and the corresponding values in Python.
"""

from __future__ import annotations

import numpy as np
import pytest

import perilune
from perilune.common.errors import InputError
from tests.api.test_flights import SYSTEM

WRONG = {
    "set": ("plant.initial_mass=950", 'give set={"plant.initial_mass": 950}'),
    "use": ("guidance=astar_guidance", """give use={"guidance": 'astar_guidance'}"""),
    "stop_time": ("5", "not a number of seconds; give stop_time=5"),
    "timeout": ("soon", "not a number of seconds; give a number"),
    "parameters": (3, "not a list; give parameters=[...]"),
    "record": (5, "not a list; give record=[...]"),
    "strict": ("yes", "neither True nor False"),
}
WRONG_CAMPAIGN = {
    "trials": ("20", "not a whole number; give trials=20"),
    "seed": (2.5, "not a whole number; give a whole number"),
    "workers": (True, "not a whole number; give a whole number"),
    "compare": ("guidance=a,b", "not a dictionary; give compare="),
}


def refused(call):
    with pytest.raises(InputError) as caught:
        call()
    assert "\n" not in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize("name", WRONG)
def test_options_of_a_simulation(name):
    argument, expected = WRONG[name]
    text = refused(lambda: perilune.simulate(SYSTEM, **{name: argument}))
    assert text.startswith(f"{name}: ")
    assert expected in text


@pytest.mark.parametrize("name", WRONG_CAMPAIGN)
def test_options_of_a_campaign(name):
    argument, expected = WRONG_CAMPAIGN[name]
    text = refused(lambda: perilune.batch(SYSTEM, "paper", **{"trials": 2} | {name: argument}))
    assert text.startswith(f"{name}: ")
    assert expected in text


def test_an_fmu_that_is_no_name():
    assert "use: guidance: 3: neither a name nor a path" in refused(
        lambda: perilune.simulate(SYSTEM, use={"guidance": 3})
    )


@pytest.mark.usefixtures("fmus")
def test_numbers_of_numpy_are_numbers():
    flight = perilune.simulate(SYSTEM, stop_time=np.float64(1.0), strict=np.bool_(False), step=np.int64(1))
    assert flight.time.tolist() == [0.0, 1.0]


@pytest.mark.usefixtures("fmus")
def test_a_plot_of_nothing_names_signals():
    flight = perilune.simulate(SYSTEM, stop_time=1.0)
    assert "give one or more of signals: plant.thrust, " in refused(flight.plot)
