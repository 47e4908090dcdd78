"""perilune shard: some shards of a campaign whose manifest is there."""

from __future__ import annotations

import argparse

from ...batch.cluster.connection import cluster
from ...batch.runner import fly_campaign, open_folder
from ...batch.shards.numbering import numbers_of
from .telling import said_how_to_go_on


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
    return 0
