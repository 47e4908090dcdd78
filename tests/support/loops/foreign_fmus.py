"""Foreign FMUs: one in C by hand, one by stock pythonfmu, without state access and units."""

from __future__ import annotations

from pathlib import Path

import fmpy
from pythonfmu import FmuBuilder

from tests.support.builders import write_zip
from tests.support.foreign.library import library

DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="integrator" guid="by hand">
<CoSimulation modelIdentifier="integrator" canHandleVariableCommunicationStepSize="true"/>
<ModelVariables>
<ScalarVariable name="u" valueReference="0" causality="input"><Real start="0"/></ScalarVariable>
<ScalarVariable name="y" valueReference="1" causality="output" initial="exact"><Real start="1"/></ScalarVariable>
</ModelVariables>
<ModelStructure><Outputs><Unknown index="2" dependencies=""/></Outputs></ModelStructure>
</fmiModelDescription>
"""
LAW = """
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Law(Fmi2Slave):
    def __init__(self, **keywords):
        super().__init__(**keywords)
        self.gain, self.u, self.y, self.last = 4.0, 0.0, 0.0, 0.0
        self.register_variable(
            Real("gain", causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable)
        )
        self.register_variable(Real("u", causality=Fmi2Causality.input))
        self.register_variable(Real("y", causality=Fmi2Causality.output))

    def exit_initialization_mode(self):
        self.last = self.u

    def do_step(self, current_time, step_size):
        self.y = -self.gain * self.last
        self.last = self.u
        return True
"""


def build_foreign_fmus(folder: Path) -> Path:
    """Build integrator.fmu (x' = u, in C) and law.fmu (y is -gain times u of one step ago, in Python) in ``folder``."""
    binary = f"binaries/{fmpy.platform}/integrator{fmpy.sharedLibraryExtension}"
    write_zip(folder / "integrator.fmu", {"modelDescription.xml": DESCRIPTION, binary: library("integrator")})
    script = folder / "law.py"
    script.write_text(LAW)
    FmuBuilder.build_FMU(script, folder)
    (folder / "Law.fmu").rename(folder / "law.fmu")
    return folder
