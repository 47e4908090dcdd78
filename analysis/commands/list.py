"""perilune list: what there is to fly."""

from __future__ import annotations

import argparse
from typing import Any

from ..api.inventory import inventory
from .common.options import check_json, tell


def run(options: argparse.Namespace) -> int:
    check_json(options)
    document = inventory()
    return tell(document, options, lambda: _print(document))


def _print(document: dict[str, Any]) -> None:
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
