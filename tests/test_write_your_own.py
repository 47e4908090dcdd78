"""The guidance of docs/write_your_own.md, built and flown as the page says.

Truth: the law meets the target by construction, so the flight ends within the paper's limits; the
FMU needs nothing but the file on the page.
"""

from __future__ import annotations

import json
import math
import re
import subprocess
import sys
from pathlib import Path

from perilune.fmus_src.export.compilers import local_platform

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "write_your_own.md").read_text(encoding="utf-8")


def test_the_example_is_built_and_lands(tmp_path: Path) -> None:
    platform = local_platform()
    assert platform is not None
    example = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)[0]
    file = tmp_path / "linear_guidance.py"
    file.write_text(example, encoding="utf-8")
    assert len(example.splitlines()) <= 32
    perilune = [sys.executable, "-m", "perilune"]
    build = [*perilune, "export", "linear_guidance.py", "--platform", platform]
    subprocess.run(build, check=True, capture_output=True, cwd=tmp_path)
    for flavour in ("python", "native"):
        fly = [*perilune, "run", "lunar_terminal_guidance", "--use", "guidance=linear_guidance", "--flavour", flavour]
        flown = subprocess.run([*fly, "--json", "-"], capture_output=True, text=True, cwd=tmp_path, check=False)
        assert flown.returncode == 0, flown.stderr
        final = json.loads(flown.stdout)["final"]
        assert math.dist([final[f"plant.position[{i}]"] for i in (1, 2, 3)], [0.0, 0.0, 2000.0]) < 1.0
        assert math.hypot(*(final[f"plant.velocity[{i}]"] for i in (1, 2, 3))) < 1.0
