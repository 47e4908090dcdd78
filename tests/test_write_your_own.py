"""Guidance of docs/write_your_own.md, built and simulated as on the page.

Truth: the law meets the target by construction, so the descent ends within the paper's limits; the FMU requires only
the file on the page.
"""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

from perilune.analysis.cli import main
from perilune.fmus_src.export.compilers import local_platform
from tests.support.documented import page_text

PAGE = page_text("docs/write_your_own.md")


def test_the_example_is_built_and_lands(tmp_path: Path, monkeypatch: Any, capsys: Any) -> None:
    platform = local_platform()
    assert platform is not None
    example = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)[0]
    (tmp_path / "linear_guidance.py").write_text(example, encoding="utf-8")
    assert len(example.splitlines()) <= 32
    monkeypatch.chdir(tmp_path)
    assert main(["export", "linear_guidance.py", "--platform", platform]) == 0
    for flavour in ("python", "native"):
        fly = ["run", "lunar_terminal_guidance", "--use", "guidance=linear_guidance", "--flavour", flavour]
        capsys.readouterr()
        assert main([*fly, "--json", "-"]) == 0
        final = json.loads(capsys.readouterr().out)["final"]
        assert math.dist([final[f"plant.position[{i}]"] for i in (1, 2, 3)], [0.0, 0.0, 2000.0]) < 1.0
        assert math.hypot(*(final[f"plant.velocity[{i}]"] for i in (1, 2, 3))) < 1.0
