"""FMUs, in C and in Python, that depend on data that earlier instances left in process, thread or folder."""

from __future__ import annotations

from enum import IntEnum
from pathlib import Path

import fmpy
from pythonfmu import FmuBuilder

from tests.support.builders import component, document, pack, system, write_zip
from tests.support.foreign.library import library

# As coupled.c numbers them.
Trace = IntEnum("Trace", "NOTHING ROUNDING TRAPS FLUSH FILES RAND GLOBAL FOLDER LOCALE ENVIRONMENT CLOCK", start=0)
DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="coupled" guid="by hand">
<CoSimulation modelIdentifier="coupled" canHandleVariableCommunicationStepSize="true"/>
<DefaultExperiment stepSize="0.25" stopTime="0.5"/>
<ModelVariables>
<ScalarVariable name="p" valueReference="0" causality="parameter" variability="fixed"><Real start="1"/>
</ScalarVariable>
<ScalarVariable name="y" valueReference="1" causality="output"><Real/></ScalarVariable>
</ModelVariables>
<ModelStructure><Outputs><Unknown index="2" dependencies=""/></Outputs><InitialUnknowns><Unknown index="2"/>
</InitialUnknowns></ModelStructure></fmiModelDescription>
"""
CAMPAIGN = """
system = "coupled"
trials = {trials}
seed = 3

[draw."coupled.p"]
distribution = "uniform"
low = 1.0
high = 2.0

[metric.last]
expression = "coupled.y"
reduction = "final"

[success]
expression = "last < 3"
"""


def coupled_fmu(folder: Path, trace: Trace, *, resets: bool = True) -> Path:
    """Build ``folder``/coupled.fmu, which leaves this trace."""
    macros = (f"-DTRACE={trace.value}", *(() if resets else ("-DKEEPS_STATE",)))
    binary = f"binaries/{fmpy.platform}/coupled{fmpy.sharedLibraryExtension}"
    return write_zip(folder / "coupled.fmu", {"modelDescription.xml": DESCRIPTION, binary: library("coupled", macros)})


def coupled_system(folder: Path, trials: int = 4) -> tuple[Path, Path]:
    """Write ``folder``/everything.ssp with an FMU for each trace but the clock, which meet each
    other; and its campaign."""
    components = []
    for trace in Trace:
        if trace is not Trace.CLOCK:
            coupled_fmu(folder, trace).rename(folder / f"{trace.name.lower()}.fmu")
            components.append(component(trace.name, trace.name.lower(), "output y Real"))
    campaign = folder / "everything.toml"
    named = CAMPAIGN.replace('"coupled"', '"everything"').replace("coupled.", f"{Trace.ROUNDING.name}.")
    campaign.write_text(named.format(trials=trials))
    return pack(folder / "everything.ssp", folder, document(system(*components), stop=0.5, step=0.25)), campaign


# The same with a module's global, or its generator, which its own seed begins, or nothing.
MODULE = """
import random

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

{seed}
count = 0


class Coupled(Fmi2Slave):
    def __init__(self, **keywords):
        super().__init__(**keywords)
        self.p, self.y = 1.0, 0.0
        self.register_variable(Real("p", causality=Fmi2Causality.parameter, variability=Fmi2Variability.fixed))
        self.register_variable(Real("y", causality=Fmi2Causality.output))

    def exit_initialization_mode(self):
        self.y = self.p

    def do_step(self, current_time, step_size):
        global count
        count += 1
        self.y += self.p * {met}
        return True
"""
MODULES = {
    "module global": MODULE.format(seed="", met="(count - 1)"),
    "seeded generator": MODULE.format(seed="random.seed(5)", met="random.random()"),
    "generator": MODULE.format(seed="", met="random.random()"),
}


def coupled_module(folder: Path, kind: str) -> Path:
    """Build ``folder``/Coupled.fmu by pythonfmu, one of MODULES."""
    script = folder / "coupled_module.py"
    script.write_text(MODULES[kind])
    return Path(FmuBuilder.build_FMU(script, folder))
