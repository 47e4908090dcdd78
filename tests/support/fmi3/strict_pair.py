""".ssp in which one strict FMU sends all its outputs to another."""

from __future__ import annotations

from pathlib import Path

from tests.support.builders import component, connection, document, pack, system
from tests.support.fmi3.strict_fmu import strict_fmu

INPUTS = """input u[1] Real; input d Integer; input wide_in Integer; input wider_in Integer; input text_in String;
input blob_in Binary; input small_in Integer; input single_in[1] Real; input single_in[2] Real"""
OUTPUTS = """output y[1] Real; output y[2] Real; output wide Integer; output wider Integer; output text String;
output blob Binary; output small Integer; output single[1] Real; output single[2] Real; output mismatches Integer"""
WIRES = {
    "y[2]": "u[1]",
    "wide": "wide_in",
    "wider": "wider_in",
    "text": "text_in",
    "blob": "blob_in",
    "small": "small_in",
    "single[1]": "single_in[1]",
    "single[2]": "single_in[2]",
}


def pack_strict_pair(folder: Path, *, stop: float = 2.0, **quirks: int) -> str:
    """Write ``folder``/pair.ssp, whose simulation ends at ``stop`` (s); ``quirks`` are those of `strict_fmu`."""
    strict_fmu(folder, **quirks)
    wires = "".join(connection(f"source.{start}", f"sink.{end}") for start, end in WIRES.items())
    root = system(
        component("source", "strict", OUTPUTS),
        component("sink", "strict", f"{OUTPUTS}; {INPUTS.replace('input d Integer; ', '')}"),
        connections=wires,
    )
    return str(pack(folder / "pair.ssp", folder, document(root, stop=stop)))
