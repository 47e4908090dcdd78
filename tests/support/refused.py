"""System of two tiny FMUs, to be altered in one place, and the form of the line that refuses it."""

import re
from pathlib import Path

from tests.support.builders import component, connection, document, pack, system

RAMP = component("ramp", "ramp", "output y Real m; output count Integer; output flag Boolean")
GAIN = component("gain", "gain", "input u Real m; output y Real m")
WIRED = connection("ramp.y", "gain.u")
PLAIN = system(RAMP, GAIN, connections=WIRED)
ONE_LINE = re.compile(r"perilune: (?P<file>[^:]+): (?P<rest>.+); (?P<remedy>[^;]+.*)\n")


def ssp(tmp_path: Path, tiny: Path, root: str = PLAIN, /, name: str = "broken.ssp", **options) -> Path:
    """Pack ``root``; ``files`` are further files of the archive, other options those of its description."""
    files = options.pop("files", {})
    return pack(tmp_path / name, tiny, document(root, **options), **files)
