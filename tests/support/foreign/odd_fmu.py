"""Builder of the odd FMU of this folder with the quirks requested by a test."""

from __future__ import annotations

from enum import IntEnum
from pathlib import Path

import fmpy

from tests.support.builders import component, document, pack, system, write_zip
from tests.support.foreign.library import library

DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="{name}" guid="by hand">
<CoSimulation modelIdentifier="{name}" canHandleVariableCommunicationStepSize="true"{once}/>
<TypeDefinitions><SimpleType name="Mode"><Enumeration><Item name="idle" value="1"/><Item name="hover" value="7"/>
</Enumeration></SimpleType></TypeDefinitions>
<DefaultExperiment stepSize="0.25"{tolerance}/>
<ModelVariables>
<ScalarVariable name="gain" valueReference="0" causality="parameter" variability="tunable"><Real start="2"/>
</ScalarVariable>
<ScalarVariable name="u" valueReference="1" causality="input"><Real start="0.5"/></ScalarVariable>
<ScalarVariable name="y" valueReference="2" causality="output" initial="exact"><Real start="0"/></ScalarVariable>
<ScalarVariable name="twice" valueReference="3" causality="calculatedParameter" variability="fixed" initial="approx">
<Real start="4"/></ScalarVariable>
<ScalarVariable name="tolerance" valueReference="4" causality="output"><Real/></ScalarVariable>
<ScalarVariable name="length" valueReference="5" causality="output"><Real/></ScalarVariable>
<ScalarVariable name="count" valueReference="0" causality="parameter" variability="fixed"><Integer start="1"/>
</ScalarVariable>
<ScalarVariable name="mode" valueReference="1" causality="parameter" variability="fixed">
<Enumeration declaredType="Mode" start="1"/></ScalarVariable>
<ScalarVariable name="on" valueReference="0" causality="parameter" variability="fixed"><Boolean start="false"/>
</ScalarVariable>
<ScalarVariable name="word" valueReference="0" causality="parameter" variability="fixed"><String start="one"/>
</ScalarVariable>
</ModelVariables>
<ModelStructure><Outputs><Unknown index="3" dependencies=""/><Unknown index="5" dependencies=""/>
<Unknown index="6" dependencies=""/></Outputs>
<InitialUnknowns><Unknown index="4"/><Unknown index="5"/><Unknown index="6"/></InitialUnknowns></ModelStructure>
</fmiModelDescription>
"""
# As deeds.h numbers them.
Call = IntEnum("Call", "CONSTRUCTION INSTANTIATION INITIALISATION STEP RESETTING FREEING", start=0)
ENDINGS = "SEGFAULT ABORT OVERFLOW EXIT_0 EXIT_1 EXIT_AT_ONCE KILL_GROUP"
OTHERS = "HANG GROW FILL RESERVE PRINT SCRIBBLE CORRUPT LEAVE_ORPHAN TRY LOG LOG_CONTROLS HANG_WITH_LOCK LOG_MILLION"
Deed = IntEnum("Deed", f"{ENDINGS} {OTHERS} CLOSE SAY", start=0)
COUNTS = """
system = "{name}"
trials = {trials}
seed = 3

[draw."{name}.count"]
distribution = "choice"
values = [1, 2, 3, 4, 5, 6, 7, 8, 9, 13]

[metric.last]
expression = "{name}.y"
reduction = "final"

[success]
expression = "last > 0"
"""  # a campaign of one such FMU, of which a tenth of the trials has a count of 13
ENDS = "input u Real; output y Real; output tolerance Real; output length Real"


def odd_fmu(
    folder: Path, name: str = "odd", *, tolerance: float | None = None, once: bool = False, **quirks: object
) -> Path:
    """Build ``folder``/name.fmu; ``quirks`` are the macros of odd.c, True for those without a value.

    ``tolerance`` is that of its default experiment, ``once`` whether it says canBeInstantiatedOnlyOncePerProcess.
    """
    macros = tuple(
        f"-D{macro}"
        if value is True
        else f'-D{macro}="{value}"'
        if isinstance(value, str)
        else f"-D{macro}={value.value if isinstance(value, IntEnum) else value}"
        for macro, value in quirks.items()
    )
    description = DESCRIPTION.format(
        name=name,
        tolerance="" if tolerance is None else f' tolerance="{tolerance}"',
        once=' canBeInstantiatedOnlyOncePerProcess="true"' if once else "",
    )
    binary = f"binaries/{fmpy.platform}/{name}{fmpy.sharedLibraryExtension}"
    path = folder / f"{name}.fmu"
    write_zip(path, {"modelDescription.xml": description, binary: library("odd", macros)})
    return path


def odd_system(folder: Path, stop: float = 1.0, **quirks: object) -> Path:
    """Write an .ssp of one such FMU, its input open at 0.5, with steps of 0.25 s."""
    odd_fmu(folder, **quirks)
    root = system(component("odd", "odd", "output y Real; output tolerance Real; output length Real"))
    return pack(folder / "odd.ssp", folder, document(root, stop=stop))
