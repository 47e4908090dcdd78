"""System of docs/write_a_system.md, read from the page, and likely mistakes of a reader."""

from __future__ import annotations

import re
from pathlib import Path

from tests.support.documented import page_text

PAGE = page_text("docs/write_a_system.md")
EXAMPLES = re.findall(r"```(\w+)\n(.*?)```", PAGE, re.DOTALL)
SSD, SSV, SHORT = "SystemStructure.ssd", "nominal.ssv", "holding/system.toml"
PLANT_ALTITUDE = '<ssd:Connector name="altitude" kind="output"><ssc:Real unit="m"/></ssd:Connector>'
TO_PLANT = (
    '      <ssd:Connection startElement="control" startConnector="thrust" endElement="plant" endConnector="thrust"/>\n'
)

FROM_MONITOR = TO_PLANT.replace("control", "monitor").replace('"thrust" endE', '"finished" endE')
TWO_INPUTS = TO_PLANT.replace('startConnector="thrust"', 'startConnector="altitude"')
BINDINGS = "    <ssd:ParameterBindings/>\n    <ssd:Connections>"

# What the page's table says of a mistake: the file, what stands there, what a reader writes instead.
MISTAKES = {
    "a connector that the FMU does not have": (SSD, PLANT_ALTITUDE, PLANT_ALTITUDE.replace("altitude", "height")),
    "a connector in another unit than the FMU's": (SSD, PLANT_ALTITUDE, PLANT_ALTITUDE.replace('"m"', '"m/s"')),
    "an undefined unit": (SSD, PLANT_ALTITUDE, PLANT_ALTITUDE.replace('"m"', '"ell"')),
    "an unconnected input": (SSD, TO_PLANT, ""),
    "an input with two sources": (SSD, TO_PLANT, TO_PLANT + FROM_MONITOR),
    "a connection of two inputs": (SSD, TO_PLANT, TWO_INPUTS),
    "a component with a typo": (SSD, 'startElement="control"', 'startElement="controll"'),
    "an FMU that is not built": (SSD, "vertical_lander.fmu", "vertical_landr.fmu"),
    "elements in another order than the schema's": (SSD, "    <ssd:Connections>", BINDINGS),
    "a parameter with a typo": (SSV, "plant.initial_altitude", "plant.initial_hight"),
    "a value in a unit that cannot be converted": (SSV, 'value="1.6" unit="km"', 'value="1.6" unit="m/s"'),
    "a duration that is not a multiple of the step": (SSD, 'size="0.1"', 'size="0.3"'),
    "a loop cut at no signal": (SSD, 'cut="control.thrust"', 'cut="control.force"'),
    "a limit of an unknown signal": (SSD, 'Limit signal="plant.speed"', 'Limit signal="plant.sped"'),
    "XML that does not close": (SSD, "    </ssd:Elements>\n", ""),
}  # fmt: skip


def write_system(folder: Path) -> None:
    """Write the files of the page to the folders ``descent`` and ``holding`` of a working folder."""
    whole = [text for kind, text in EXAMPLES if kind == "xml" and text.startswith("<?xml") and text.count("\n") > 8]
    (sets,) = [text for text in whole if "ParameterSet>" in text]
    (ssd,) = [text for text in whole if "</ssd:SystemStructureDescription>" in text]
    (blocks,) = [text for kind, text in EXAMPLES if kind == "python" and "(Block)" in text]
    (short,), (campaign,) = (
        [t for kind, t in EXAMPLES if kind == "toml" and each in t] for each in ("[comp", "trials")
    )
    files = {"blocks.py": blocks, SSD: ssd, SSV: sets, "campaigns/dispersed.toml": campaign}
    for name, text in {**{f"descent/{each}": text for each, text in files.items()}, SHORT: short}.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
