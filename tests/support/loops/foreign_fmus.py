"""FMUs as others make them: one in C by hand, one by stock pythonfmu; no memory to be had of them, and no units."""

from __future__ import annotations

import subprocess
from pathlib import Path

import fmpy
from pythonfmu import FmuBuilder

from perilune.fmus_src.export.compilers import FLAGS, compilers_for
from tests.support.builders import write_zip

INTEGRATOR = """
#include <stdlib.h>
#include "fmi2Functions.h"

typedef struct { double value[2]; } Integrator; /* u, y */

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }
fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String place,
                              const fmi2CallbackFunctions *call, fmi2Boolean visible, fmi2Boolean logging)
{ return calloc(1, sizeof(Integrator)); }
void fmi2FreeInstance(fmi2Component c) { free(c); }
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[]) { return fmi2OK; }
fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean known, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean ends, fmi2Real stop) { return fmi2OK; }
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { ((Integrator *)c)->value[1] = 1.0; return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Terminate(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) { *(Integrator *)c = (Integrator){{0.0, 0.0}}; return fmi2OK; }
fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Real v[])
{ for (size_t i = 0; i < n; i++) v[i] = ((Integrator *)c)->value[r[i]]; return fmi2OK; }
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Real v[])
{ for (size_t i = 0; i < n; i++) ((Integrator *)c)->value[r[i]] = v[i]; return fmi2OK; }
fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Integer v[])
{ return n ? fmi2Error : fmi2OK; }
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer v[])
{ return n ? fmi2Error : fmi2OK; }
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Boolean v[])
{ return n ? fmi2Error : fmi2OK; }
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Boolean v[])
{ return n ? fmi2Error : fmi2OK; }
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean final)
{ double *v = ((Integrator *)c)->value; v[1] += h * v[0]; return fmi2OK; }

/* All that it cannot do. */
#define NOT(name, ...) fmi2Status name(fmi2Component c, __VA_ARGS__) { return fmi2Error; }
typedef const fmi2ValueReference *References;
fmi2Status fmi2CancelStep(fmi2Component c) { return fmi2Error; }
NOT(fmi2GetString, References r, size_t n, fmi2String v[])
NOT(fmi2SetString, References r, size_t n, const fmi2String v[])
NOT(fmi2GetFMUstate, fmi2FMUstate *s)
NOT(fmi2SetFMUstate, fmi2FMUstate s)
NOT(fmi2FreeFMUstate, fmi2FMUstate *s)
NOT(fmi2SerializedFMUstateSize, fmi2FMUstate s, size_t *n)
NOT(fmi2SerializeFMUstate, fmi2FMUstate s, fmi2Byte b[], size_t n)
NOT(fmi2DeSerializeFMUstate, const fmi2Byte b[], size_t n, fmi2FMUstate *s)
NOT(fmi2GetDirectionalDerivative, References u, size_t n, References k, size_t m, const fmi2Real d[], fmi2Real v[])
NOT(fmi2SetRealInputDerivatives, References r, size_t n, const fmi2Integer order[], const fmi2Real v[])
NOT(fmi2GetRealOutputDerivatives, References r, size_t n, const fmi2Integer order[], fmi2Real v[])
NOT(fmi2GetStatus, const fmi2StatusKind k, fmi2Status *v)
NOT(fmi2GetRealStatus, const fmi2StatusKind k, fmi2Real *v)
NOT(fmi2GetIntegerStatus, const fmi2StatusKind k, fmi2Integer *v)
NOT(fmi2GetBooleanStatus, const fmi2StatusKind k, fmi2Boolean *v)
NOT(fmi2GetStringStatus, const fmi2StatusKind k, fmi2String *v)
"""
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
    """integrator.fmu (x' = u, in C) and law.fmu (y is -gain times u of one step ago, in Python) in ``folder``."""
    source, library = folder / "integrator.c", folder / f"integrator{fmpy.sharedLibraryExtension}"
    source.write_text(INTEGRATOR)
    headers = Path(fmpy.__file__).parent / "c-code"
    subprocess.run([*compilers_for(fmpy.platform)[0], *FLAGS, f"-I{headers}", "-o", library, source], check=True)
    binary = f"binaries/{fmpy.platform}/{library.name}"
    write_zip(folder / "integrator.fmu", {"modelDescription.xml": DESCRIPTION, binary: library.read_bytes()})
    script = folder / "law.py"
    script.write_text(LAW)
    FmuBuilder.build_FMU(script, folder)
    (folder / "Law.fmu").rename(folder / "law.fmu")
    return folder
