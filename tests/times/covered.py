"""Lines and branches that the suite executes, by top folder, from `coverage json`: `make coverage` prints the table.

Code that runs in C only, and the copies of sources inside Python FMUs, do not count.
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from pathlib import Path

COUNTED = ("covered_lines", "num_statements", "covered_branches", "num_branches")
TOPS = ("analysis", "common", "fmus_src")


def table(report: Path) -> str:
    """Return a Markdown table with the percentage of lines and of branches executed in each top folder."""
    counts: dict[str, Counter[str]] = {top: Counter() for top in TOPS}
    for path, file in json.loads(report.read_text(encoding="utf-8"))["files"].items():
        counts[path.split("/")[0]].update({key: file["summary"][key] for key in COUNTED})
    rows = ["| Folder | Lines | Branches |", "| --- | --- | --- |"]
    for top, each in counts.items():
        lines = each["covered_lines"] / each["num_statements"]
        branches = each["covered_branches"] / each["num_branches"]
        totals = each["num_statements"], each["num_branches"]
        rows.append(f"| `{top}` | {lines:.1%} of {totals[0]:,} | {branches:.1%} of {totals[1]:,} |")
    return "\n".join(rows)


if __name__ == "__main__":
    print(table(Path(sys.argv[1])))
