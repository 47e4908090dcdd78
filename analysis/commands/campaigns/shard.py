"""perilune shard: some shards of a campaign whose manifest is there."""

from __future__ import annotations

import argparse

from ...campaigns.fly.cluster.connection import cluster
from ...campaigns.fly.runner import fly_campaign, open_folder
from ...campaigns.fly.shards.numbering import numbers_of
from ...common.targets import Results
from ..common.exit_status import exit_status
from .telling import failed_flights, report_failed, said_how_to_go_on


def run(options: argparse.Namespace) -> int:
    shards = numbers_of(options.shards)
    campaign = open_folder(options.folder)
    wanted = campaign.checked(shards)
    workers, engine = options.workers, options.engine
    with (
        said_how_to_go_on(options.folder),
        cluster(options.scheduler, workers=workers, engine=engine) as elsewhere,
    ):
        fly_campaign(campaign, wanted, workers=workers, engine=engine, elsewhere=elsewhere)
    missing, count = len(campaign.missing()), campaign.numbering.count
    print(f"shards: {len(wanted)} flown, {len(shards) - len(wanted)} were there, {missing} of {count} are missing")
    flown = sorted(set(wanted) - set(campaign.missing()))
    failures = failed_flights(campaign.shard_rows(shard) for shard in flown)
    report_failed(failures, campaign.plan, options.folder)
    return exit_status(Results(), not failures)
