"""perilune merge: the result of a campaign whose shards are all flown."""

from __future__ import annotations

import argparse

from ...campaigns.fly.runner import merge, open_folder
from ...common.targets import PAGES, Results, check_file
from ..common.options import check_json
from .telling import asked_requirements, said_how_to_go_on, tell


def run(options: argparse.Namespace) -> int:
    check_file("--report", options.report, PAGES)
    check_json(options)
    files = Results()
    campaign = open_folder(options.folder)
    requirements = asked_requirements(campaign.plan, options.require)
    with said_how_to_go_on(options.folder):
        result = merge(campaign)
    files.written.append(options.folder)
    return tell(result, options, requirements, files)
