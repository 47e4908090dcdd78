"""Figure docs/images/landing.svg: `python -m docs.figures.readme_figure`, after build_fmus.py."""

from __future__ import annotations

from pathlib import Path

from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.common.process import exit_process

from .landing import fly_landings, landing_figure
from .pictures import IMAGES, write_picture

SYSTEM, CAMPAIGN = "lunar_terminal_guidance", "paper"
LANDING = 42  # the trial shown in full: it starts 9.5 degrees off the direction to the site
SAMPLE = 18  # trials in the background


def sample_trials() -> list[int]:
    """Return the trials in the background of the landing, which is not among them."""
    return [trial for trial in range(SAMPLE + 1) if trial != LANDING]


def draw_readme_figure(path: Path) -> None:
    """Simulate trials of the published campaign with its first method and write the figure."""
    others = sample_trials()
    plan = read_plan(SYSTEM, CAMPAIGN, SystemOptions(), trials=max(LANDING, *others) + 1)
    flights = fly_landings(plan, plan.campaign.variants()[0], [LANDING, *others])
    figure = landing_figure(flights[0], flights[1:])
    write_picture(figure, path)


if __name__ == "__main__":
    target = IMAGES / "landing.svg"
    draw_readme_figure(target)
    print(target)
    exit_process(0)
