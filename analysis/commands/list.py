"""perilune list: what there is to fly."""

from __future__ import annotations

import argparse

from ..api.inventory import inventory
from .common.options import add_json, write_json


def add(parser: argparse.ArgumentParser) -> None:
    add_json(parser)


def run(options: argparse.Namespace) -> int:
    document = inventory()
    if write_json(document, options.json):
        return 0
    for name, system in document["systems"].items():
        print(name)
        print(f"  parameter sets  {', '.join(system['parameter_sets']) or 'none'}")
        print(f"  campaigns       {', '.join(system['campaigns']) or 'none'}")
        print(f"  loops           {', '.join(system['loops']) or 'none'}")
    print(f"laws              {', '.join(document['laws'])}")
    print(f"searches          {', '.join(document['searches'])}")
    print("FMUs")
    width = max((len(name) for name in document["fmus"]), default=0)
    for name, entry in document["fmus"].items():
        print(f"  {name:{width}}  {'+'.join(entry['built']) or 'not built':13}  {entry['description']}")
    return 0
