"""The text of the project in numbers: `python -m tests.house`. The definition of each is its function's docstring."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from . import likeness, names, prose, repeated, size, structure
from .sources import ROOT, Checkout

# Measure, its function, and its goal.
MEASURES = (
    ("analysis and common", size.analysis, "a tenth less, about 350 files, about 40 packages"),
    ("pairs of places with six like lines", likeness.like_lines, "the top 45 gone, none an option list"),
    ("found as a name", structure.actual, "0"),
    ("functions named by a past participle", structure.participles, "< 20"),
    ("openings of docstrings to give up", prose.openings, "< 80"),
    ("phrases to give up in docstrings and comments", prose.phrases, "< 200"),
    ("dict[str, Any] / Any", structure.untyped, "< 50 / < 300"),
    ("--flag outside of the command line", structure.flags, "0"),
    ("module functions used once with six lines or fewer", structure.used_once, "a verdict each"),
    ("files of 35 lines or fewer (with __init__)", size.small_files, "< 60"),
    ("class names that occur again", repeated.classes, "< 15"),
    ("files of one name, three times and more", repeated.files, "<= 3 of a name"),
    ("functions over 50 lines", repeated.long_functions, "< 8"),
    ("circles of files", structure.circles, "0"),
    ("pictures in git", size.pictures, "under 100 kB each"),
    ("campaign TOML", size.campaigns, "<= 3000 lines"),
    ("in the wheel for the project only", size.project_only, "0 lines"),
    ("documentation", size.documentation, "<= 50000 words"),
    ("longest Python file", size.longest_file, "hardly any over 300"),
)


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.house", description=__doc__)
    parser.add_argument("--json", action="store_true", help="print the table as JSON")
    parser.add_argument(
        "--list", metavar="TEXT", help="print where: of measures whose title has TEXT, or of a limited name"
    )
    parser.add_argument(
        "--ratchet", action="store_true", help="lower the numbers of limits.toml and prose.toml to what is counted"
    )
    parser.add_argument("--root", type=Path, default=ROOT, help="another checkout to count (default: this one)")
    arguments = parser.parse_args()
    checkout = Checkout(arguments.root)
    limits = names.read_limits()
    if arguments.ratchet:
        text = names.LIMITS.read_text(encoding="utf-8")
        names.LIMITS.write_text(names.lower_limits(text, names.count_words(checkout.sources, limits)), encoding="utf-8")
        counts = prose.count(checkout.sources, prose.read_limits())
        text = prose.LIMITS.read_text(encoding="utf-8")
        prose.LIMITS.write_text(prose.lower_limits(counts, text), encoding="utf-8")
    elif arguments.list:
        for title, measure, _ in MEASURES:
            if arguments.list in title:
                print(f"{title}: {(measured := measure(checkout))[0]}", *measured[1], sep="\n")
        for source in checkout.sources if any(arguments.list in table for table in limits.values()) else ():
            for name, line in names.given_names(source):
                if arguments.list in names.words(name) | {names.whole(name)}:
                    print(f"{source.path}:{line} {name}")
    else:
        rows = [
            {"measure": title, "now": measure(checkout)[0], "wanted": wanted} for title, measure, wanted in MEASURES
        ]
        lines = [" | ".join(row.values()) for row in ({"m": "measure", "n": "now", "w": "wanted"}, *rows)]
        print(json.dumps(rows, indent=2) if arguments.json else "\n".join(lines))


if __name__ == "__main__":
    main()
