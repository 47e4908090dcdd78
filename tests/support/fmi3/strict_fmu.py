"""Builder of this folder's strict FMU: every type, array sized by a structural parameter, events, early returns."""

from __future__ import annotations

from pathlib import Path

import fmpy

from tests.support.builders import write_zip
from tests.support.foreign.library import library

TROUBLES = (
    *("fine", "fails", "discards", "dies", "stands_still", "never_settles", "talks"),
    *("no_time", "no_end", "goes_back", "goes_beyond"),
)
ITEMS = "".join(f'<Item name="{name}" value="{number}"/>' for number, name in enumerate(TROUBLES))
DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="Strict" instantiationToken="by hand">
<CoSimulation modelIdentifier="Strict" canHandleVariableCommunicationStepSize="true" hasEventMode="{events}"
 mightReturnEarlyFromDoStep="true" providesIntermediateUpdate="true"/>
<UnitDefinitions><Unit name="m"><BaseUnit m="1"/></Unit></UnitDefinitions>
<TypeDefinitions><Float64Type name="Length" unit="m" min="-100"/>
<EnumerationType name="Trouble">{items}</EnumerationType></TypeDefinitions>
<DefaultExperiment startTime="0" stopTime="1" stepSize="0.25"{tolerance}/>
<ModelVariables>
<Float64 name="time" valueReference="0" causality="independent" variability="continuous"/>
<UInt64 name="n" valueReference="1" causality="structuralParameter" variability="fixed" start="2" min="0" max="4"/>
<Float64 name="gain" valueReference="2" causality="parameter" variability="fixed" start="1 2">
<Dimension valueReference="1"/><Alias name="factor"/></Float64>
<Float64 name="u" valueReference="3" causality="input" declaredType="Length" start="0.5 0.25">
<Dimension valueReference="1"/></Float64>
<Float64 name="y" valueReference="4" causality="output" unit="m"><Dimension valueReference="1"/></Float64>
<Int32 name="d" valueReference="5" causality="input" start="0"/>
<Int32 name="events" valueReference="6" causality="output"/>
<Int32 name="accepted" valueReference="7" causality="output"/>
<Float64 name="early" valueReference="8" causality="parameter" variability="fixed" start="0"/>
<Int32 name="returns" valueReference="9" causality="output"/>
<Int32 name="rounds" valueReference="10" causality="parameter" variability="fixed" start="0"/>
<Float64 name="end_at" valueReference="11" causality="parameter" variability="fixed" start="1e9"/>
<Enumeration name="trouble" valueReference="12" causality="parameter" variability="fixed" declaredType="Trouble"
 start="0"/>
<Int64 name="wide" valueReference="13" causality="output"/>
<UInt64 name="wider" valueReference="14" causality="output"/>
<Int64 name="wide_in" valueReference="15" causality="input" start="9007199254740993"/>
<UInt64 name="wider_in" valueReference="16" causality="input" start="18446744073709551615"/>
<Int32 name="mismatches" valueReference="17" causality="output"/>
<String name="text" valueReference="18" causality="output"/>
<String name="text_in" valueReference="19" causality="input"><Start value="step 0"/></String>
<Binary name="blob" valueReference="20" causality="output"/>
<Binary name="blob_in" valueReference="21" causality="input"><Start value="0000ff"/></Binary>
<Int8 name="small" valueReference="22" causality="output"/>
<Int8 name="small_in" valueReference="23" causality="input" start="-50"/>
<Float64 name="tolerance" valueReference="24" causality="output"/>
<Float32 name="single" valueReference="25" causality="output"><Dimension start="2"/></Float32>
<Float32 name="single_in" valueReference="26" causality="input" start="0 -1"><Dimension start="2"/></Float32>
</ModelVariables>
<ModelStructure>{outputs}</ModelStructure>
</fmiModelDescription>
"""
QUIRKS = {"blob_size": 3, "is_lenient": 0, "hides_gain": 0, "clamps_rounds": 0}
OUTPUTS = (4, 6, 7, 9, 13, 14, 17, 18, 20, 22, 24, 25)


def strict_fmu(
    folder: Path, *, events: bool = False, tolerance: float | None = None, name: str = "strict", **quirks: int
) -> Path:
    """Build ``folder``/name.fmu; with ``events`` it has event mode.

    ``quirks`` are blob_size, the bytes that it says its Binary output has; is_lenient: discrete inputs may be set in
    step mode too, though there is event mode, as FMPy does it; hides_gain: it does not return that parameter;
    clamps_rounds: it lets that one be 2 at most.
    """
    structure = "".join(f'<Output valueReference="{each}" dependencies=""/>' for each in OUTPUTS)
    structure += "".join(f'<InitialUnknown valueReference="{each}"/>' for each in OUTPUTS)
    description = DESCRIPTION.format(
        events=str(events).lower(),
        items=ITEMS,
        outputs=structure,
        tolerance="" if tolerance is None else f' tolerance="{tolerance}"',
    )
    binary = f"binaries/{fmpy.platform_tuple}/Strict{fmpy.sharedLibraryExtension}"
    macros = tuple(
        f"-D{key.upper()}={int(number)}" for key, number in {**QUIRKS, **quirks, "has_events": events}.items()
    )
    files = {"modelDescription.xml": description, binary: library("strict", macros, Path(__file__).parent)}
    return write_zip(folder / f"{name}.fmu", files)
