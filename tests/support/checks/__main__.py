"""Writer of checks/NAME.csv and checks/NAME.toml next to the blocks, for all truths or the named ones."""

import sys
from pathlib import Path

from tests.support.checks.truths import TRUTHS

ROOT = Path(__file__).parents[3]

if __name__ == "__main__":
    for name in sys.argv[1:] or TRUTHS:
        kind, truth = TRUTHS[name]
        truth().write(ROOT / "fmus_src" / kind / "checks", name)
