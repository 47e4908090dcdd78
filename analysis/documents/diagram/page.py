"""Page of `perilune describe --report`: block diagram, blocks, connections and parameters of a system."""

from __future__ import annotations

from pathlib import Path

from ...runtime.system.prepared import PreparedSystem
from ..common.page import write_page
from .diagram import block_table, connection_table, make_diagram, parameter_table

TEMPLATE = Path(__file__).with_name("system.html")


def write_system_page(prepared: PreparedSystem, path: Path) -> None:
    """Write one self-contained HTML page about a prepared system, reproducible to the byte."""
    diagram = make_diagram(prepared)
    name, file = prepared.archive.name, Path(prepared.network.file).name
    write_page(
        path,
        TEMPLATE,
        title=name,
        file=file if prepared.archive.is_fmu else f"{name}/{file}",
        step=prepared.step,
        stop_time=prepared.start + prepared.steps * prepared.step,
        algorithm=prepared.algorithm,
        diagram=diagram,
        blocks=block_table(diagram.system),
        connections=connection_table(diagram.system),
        parameters=parameter_table(prepared, diagram.system),
    )
