"""Demonstration `make demo`: builds FMUs, simulates comparison and landing, writes build/demo."""

from __future__ import annotations

import sys
import time
from dataclasses import replace
from pathlib import Path

from perilune import simulate
from perilune.analysis.campaigns.definition.plan import BatchPlan, read_plan
from perilune.analysis.campaigns.execute.campaign_result import CampaignResult
from perilune.analysis.campaigns.execute.runner import run_batch
from perilune.analysis.documents.of.batch.batch import batch_document
from perilune.analysis.documents.of.simulation.run import RunContext, run_document
from perilune.analysis.documents.render.html import write_document
from perilune.analysis.runtime.flight.results import FlightResult
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.shipped import main as build
from perilune.common.errors import InputError
from perilune.common.paths import BUILD
from perilune.common.process import exit_process

from .landing import fly_landings
from .page import write_demo_page
from .readme_figure import CAMPAIGN, LANDING, SYSTEM, sample_trials

TRIALS = 300
MISSION = "mission.html"


def main(output: Path = BUILD / "demo", trials: int = TRIALS) -> int:
    """Run the demonstration; return the exit status."""
    began = time.perf_counter()
    print("Building the FMUs and systems ...", flush=True)
    status = build([])
    if status:
        return status
    try:
        page = fly(output, trials)
        mission = fly_mission(output)
    except InputError as error:
        print(f"perilune demo: {error}", file=sys.stderr)
        return 2
    print(f"Done in {time.perf_counter() - began:.0f} s. Open {page} and, for a landing in three dimensions, {mission}")
    return 0


def fly(output: Path, trials: int) -> Path:
    """Run all simulations and write all files into ``output``; return the path of the page."""
    plan = read_plan(SYSTEM, CAMPAIGN, SystemOptions(), trials=trials)
    print(f"Flying trial {LANDING} of the campaign with {plan.campaign.variants()[0].name} ...", flush=True)
    landing, sample = fly_sample(plan)
    variants = len(plan.campaign.variants())
    print(f"Comparing {variants} guidances over {trials} trials each ...", flush=True)
    batch = run_batch(plan, output=output)
    return write_files(landing, sample, batch, output)


def fly_mission(output: Path) -> Path:
    """Simulate a whole landing from a 100 km orbit, with its scene and block diagram; return the path of its page."""
    print("Flying a landing from orbit to contact ...", flush=True)
    page = output / MISSION
    simulate("landing_mission").report(page)
    return page


def fly_sample(plan: BatchPlan) -> tuple[FlightResult, list[FlightResult]]:
    """Simulate one landing of the campaign's first variant with all signals, and others to show for comparison."""
    others = sample_trials()
    larger = read_plan(SYSTEM, CAMPAIGN, plan.options, trials=max(LANDING, *others) + 1)
    flights = fly_landings(larger, larger.campaign.variants()[0], [LANDING, *others])
    return flights[0], flights[1:]


def write_files(landing: FlightResult, sample: list[FlightResult], batch: CampaignResult, output: Path) -> Path:
    """Write the landing's data, the two full reports and the page; files of the batch exist already."""
    print("Writing pages ...", flush=True)
    landing.write(output / "landing.csv")
    title = f"Lunar landing: trial {LANDING} of campaign {CAMPAIGN}"
    write_document(run_document(landing, RunContext(title=title)), output / "landing.html")
    compared = replace(batch_document(batch), title="Lunar terminal guidance: three methods compared")
    write_document(compared, output / "comparison.html")
    page = output / "index.html"
    write_demo_page(landing, sample, batch, page)
    return page


if __name__ == "__main__":
    exit_process(main())
