"""Lag as exported by other tools: in C, without `dependencies` in its model description and without state access."""

from __future__ import annotations

from pathlib import Path

import fmpy

from tests.support.builders import write_zip
from tests.support.foreign.library import library

DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="lag" guid="by hand">
<CoSimulation modelIdentifier="lag" canHandleVariableCommunicationStepSize="true"/>
<ModelVariables>
<ScalarVariable name="u" valueReference="0" causality="input"><Real start="0"/></ScalarVariable>
<ScalarVariable name="y" valueReference="1" causality="output"><Real/></ScalarVariable>
</ModelVariables>
<ModelStructure><Outputs><Unknown index="2"/></Outputs><InitialUnknowns><Unknown index="2"/></InitialUnknowns>
</ModelStructure></fmiModelDescription>
"""


def lag_fmu(folder: Path, time_constant: float) -> Path:
    """Build ``folder``/lag.fmu: time_constant (s) y' = u - y, from y = 0 on."""
    binary = f"binaries/{fmpy.platform}/lag{fmpy.sharedLibraryExtension}"
    content = library("lag", (f"-DTAU={time_constant}",))
    return write_zip(folder / "lag.fmu", {"modelDescription.xml": DESCRIPTION, binary: content})
