"""Section on a block's check: reference solution, tolerance of each output, and error of the shipped FMU."""

from __future__ import annotations

import csv
import io
import zipfile
from collections import defaultdict

from perilune.common.paths import shipped_fmu
from perilune.fmus_src.block import Block
from perilune.fmus_src.evidence.block import OUTPUTS
from perilune.fmus_src.evidence.check import TIME, Check, elements_of, read_check
from perilune.fmus_src.evidence.manifest import FOLDER

from .markdown import escaped, table

EXACT = "0"


def check_section(block: type[Block]) -> str:
    """Return the table of a block's check; empty without one."""
    check = read_check(block)
    if check is None:
        return ""
    differences = _differences(block, check)
    rows: dict[tuple[str, str], list[str]] = defaultdict(list)
    largest: dict[tuple[str, str], float] = defaultdict(float)
    elements = elements_of(block)
    for element, (absolute, relative) in check.tolerances.items():
        key = (f"{absolute:g}", f"{relative:g}")
        name = f"`{elements[element].name}`"
        if name not in rows[key]:
            rows[key].append(name)
        largest[key] = max(largest[key], differences.get(element, 0.0))
    lines = [
        [*key, f"{largest[key]:.1e}" if largest[key] else EXACT, ", ".join(names)]
        if differences
        else [*key, ", ".join(names)]
        for key, names in rows.items()
    ]
    head = ["absolute tolerance", "relative tolerance", *(["largest difference"] if differences else []), "outputs"]
    return (
        f"Truth: {escaped(check.truth)}. The reference is computed without the block's code: {check.stop_time:g} s in "
        f"steps of {check.step:g} s, with the inputs and parameters of `{check_file(block)}`. "
        f"`perilune verify {block.fmu_name}` repeats it.\n\n" + table(head, lines)
    )


def check_file(block: type[Block]) -> str:
    """Return the path of the check within the package."""
    return "/".join([*block.__module__.split(".")[1:-1], "checks", f"{block.fmu_name}.toml"])


def _differences(block: type[Block], check: Check) -> dict[str, float]:
    """Return the largest error of each output as recorded in the native FMU; empty without a record."""
    if block.python_only:
        return {}
    with zipfile.ZipFile(shipped_fmu(block.fmu_name, "native")) as archive:
        text = archive.read(f"{FOLDER}/{OUTPUTS}").decode()
    reference = check.columns()
    recorded = {row.pop(TIME): row for row in csv.DictReader(io.StringIO(text))}
    return {
        name: max(abs(float(row[name]) - value) for row, value in zip(recorded.values(), reference[name], strict=True))
        for name in check.tolerances
    }
