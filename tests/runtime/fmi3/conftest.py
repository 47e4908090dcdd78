"""A strict FMU of FMI 3.0 for each test, with and without event mode."""

import pytest

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


@pytest.fixture
def strict_pair(tmp_path):
    """Makes an .ssp in which one strict FMU gives all that it has to another; keywords are those of `strict_fmu`."""

    def make(*, stop=2.0, **quirks):
        strict_fmu(tmp_path, **quirks)
        wires = "".join(connection(f"source.{start}", f"sink.{end}") for start, end in WIRES.items())
        root = system(
            component("source", "strict", OUTPUTS),
            component("sink", "strict", f"{OUTPUTS}; {INPUTS.replace('input d Integer; ', '')}"),
            connections=wires,
        )
        return str(pack(tmp_path / "pair.ssp", tmp_path, document(root, stop=stop)))

    return make
