"""Check that the FMUs in build/fmus and the SSDs of systems are not older than their sources."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from pathlib import Path

from perilune import fmus_src
from perilune.analysis.compose.files import report_changed_source
from perilune.analysis.runtime.ssp.archive import system_names
from perilune.common.paths import SYSTEMS, shipped_fmu


@cache
def newest_source() -> float:
    """Return the time of the last change of the FMUs' sources, the translator's among them."""
    sources = Path(fmus_src.__file__).parent.rglob("*")
    return max(source.stat().st_mtime for source in sources if source.suffix in (".py", ".c", ".h", ".csv", ".toml"))


def native_are_current(names: Iterable[str]) -> bool:
    """Return True if these native FMUs exist and are not older than any source."""
    paths = [shipped_fmu(name, "native") for name in names]
    return all(path.is_file() and path.stat().st_mtime >= newest_source() for path in paths)


def systems_are_current() -> bool:
    """Return True if every shipped system has an SSD composed of its present files."""
    folders = [SYSTEMS / name for name in system_names()]
    return all((each / "SystemStructure.ssd").is_file() and not report_changed_source(each) for each in folders)
