"""Figures of a simulation of landing_mission.

Truth: phase times reported by the sequencer, recorded masses at these times, and the outputs of the contact monitor.
"""

import re

import numpy as np
import pytest

import perilune
from perilune.analysis.documents.figures.declared import BudgetFigure, LimitsFigure, PhasesFigure
from perilune.analysis.documents.figures.figure_reader import read_figures
from perilune.analysis.documents.of.simulation.figures.limits import is_met
from perilune.analysis.documents.of.simulation.figures.phase_figure import (
    amount,
    consumption_by_phase,
    spans_of,
    statuses_of,
)
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.documents.subsections import figure_sections

pytestmark = pytest.mark.usefixtures("fmus")


@pytest.fixture(scope="module")
def figures(fmus):
    return read_figures(prepare_system("landing_mission"))


@pytest.fixture(scope="module")
def result(fmus):
    """Simulate from the beginning of the braking to contact."""
    return perilune.simulate("landing_mission", parameters=["start_3.ssv"])


def one(figures, kind):
    (actual,) = (figure for figure in figures if isinstance(figure, kind))
    return actual


def test_phases_are_those_that_the_sequencer_tells(figures, result):
    phases = one(figures, PhasesFigure)
    spans = spans_of(phases, result)
    named = {phase.name: phase.value for phase in phases.phases}
    assert [span.name for span in spans] == list(named)[2:]
    final = result.final()
    for value in range(3, 9):
        own = [span for span in spans if named[span.name] == value]
        assert own[0].begin == pytest.approx(final[f"sequencer.phase_time[{value}]"], abs=1e-9)
        ends = [final[f"sequencer.phase_time[{number}]"] for number in (value, value + 1)]
        before, after = np.interp(ends, result.time, result["plant.mass"])
        assert sum(span.spent for span in own) == pytest.approx(before - after, abs=1e-9)
    reported = [final[f"sequencer.status_time[{status}]"] for status in range(1, 10)]
    assert dict(statuses_of(phases, result)) == {status: time for status, time in enumerate(reported, 1) if time >= 0.0}


def test_the_budget_is_what_was_flown_over_its_bound(figures, result):
    """The pieces' bounds cancel, so that the items together are what all phases from the braking on used up."""
    budget = one(figures, BudgetFigure)
    spent = consumption_by_phase(budget, result)
    amounts = [amount(item, spent, budget.bound) for item in budget.items]
    mass = result["plant.mass"]
    assert sum(amounts) == pytest.approx(mass[0] - mass[-1], abs=1e-9)
    assert min(amounts) > 0.0  # no flight beats its bound
    section = figure_sections([budget], result)[0]
    exact = [float(re.search(r'value="([^"]+)"', row[1])[1]) for row in section.table.rows]
    np.testing.assert_allclose(exact, [*amounts, sum(amounts), mass[0] - mass[-1]], atol=1e-9)


def test_limits_are_kept_where_the_monitor_says_so(figures, result):
    limits = one(figures, LimitsFigure)
    assert result.final()["touchdown.within_limits"]
    assert all(is_met(limit, result) for limit in limits.limits)
    hard = perilune.simulate("landing_mission", parameters=["start_9.ssv"], set={"plant.initial_velocity[3]": -6.0})
    assert not hard.final()["touchdown.within_limits"]
    assert [limit.name for limit in limits.limits if not is_met(limit, hard)] == ["vertical speed"]


def test_all_figures_are_drawn(figures, result):
    sections = figure_sections(figures, result)
    assert len(sections) == len(figures) - 1 > 10  # the scene is not a plot
    assert not any(
        "Not plotted" in words for section in sections for words in section.notes if "coast" not in section.title
    )
    wide = sum(len(section.plot.svg) for section in sections if section.plot is not None)
    size = wide + sum(len(panel.figure.svg) for section in sections for panel in section.panels)
    assert size < 500_000
