"""FMU of either version of FMI that passes numbers on, with units declared by a test."""

from __future__ import annotations

from pathlib import Path

import fmpy
from lxml import etree

from perilune.fmus_src.export.own_blocks import build_own_blocks
from tests.support.builders import retouched

BLOCK = '''
from perilune.fmus_src.block import Block, Input, Output, Parameter


class Passing(Block):
    """y is start throughout, z is u at the same time."""

    start = Parameter(10.0, unit="K", description="the value of y")
    u = Input(0.0, unit="K", description="input")
    y = Output(0.0, unit="K", description="start")
    z = Output(0.0, unit="K", direct=True, description="u")

    def initialize(self) -> None:
        self.y = self.start
        self.z = self.u

    def step(self, t: float, h: float) -> None:
        self.y = self.start
        self.z = self.u
'''
UNITS = {
    "K": '<BaseUnit K="1"/>',
    "degC": '<BaseUnit K="1" offset="273.15"/>',
    "Cel": '<BaseUnit K="1" offset="273.15"/>',
    "degF": '<BaseUnit K="1" factor="0.5555555555555556" offset="255.3722222222222"/>',
    "m": '<BaseUnit m="1"/>',
    "km": '<BaseUnit m="1" factor="1000"/>',
    "rad": '<BaseUnit rad="1"/>',
    "1": "<BaseUnit/>",
    "N.m": '<BaseUnit kg="1" m="2" s="-2"/>',
    "J": '<BaseUnit kg="1" m="2" s="-2"/>',
    "EUR": "",
    "USD": "",
}


def build_passing(folder: Path) -> None:
    """Build the FMU of both versions as ``folder``/native and ``folder``/fmi3."""
    folder.mkdir(parents=True, exist_ok=True)
    blocks = folder / "passing_blocks.py"
    blocks.write_text(BLOCK)
    for version, platform in ((2, fmpy.platform), (3, fmpy.platform_tuple)):
        build_own_blocks(blocks, folder, ["native"], [platform], fmi=version)


def passing_fmu(folder: Path, built: Path, name: str, version: int = 2, units: str = "", **declared: str) -> Path:
    """Write ``folder``/name.fmu; ``declared`` are attributes of variables, such as ``y="degC relativeQuantity=true"``.

    The first word is the unit, "-" for none. There is a type `Difference` with relativeQuantity, in degC. ``units`` are
    further Unit elements.
    """

    def change(text: str) -> str:
        root = etree.fromstring(text.encode())
        for variable, attributes in declared.items():
            (element,) = root.iterfind(f"ModelVariables/*[@name='{variable}']")
            target = element[0] if version == 2 else element
            unit, *others = attributes.split()
            target.attrib.pop("unit")
            for attribute in (*([f"unit={unit}"] if unit != "-" else []), *others):
                target.set(*attribute.split("="))
        quantity = '{} name="Difference"{} unit="degC" relativeQuantity="true"/>'
        real = quantity.format("<SimpleType", "><Real") + "</SimpleType>"
        types = real if version == 2 else quantity.format("<Float64Type", "")
        inner = "".join(f'<Unit name="{unit}">{base}</Unit>' for unit, base in UNITS.items())
        definitions = root.find("UnitDefinitions")
        index = root.index(definitions)
        root[index] = etree.fromstring(f"<UnitDefinitions>{inner}{units}</UnitDefinitions>")
        root.insert(index + 1, etree.fromstring(f"<TypeDefinitions>{types}</TypeDefinitions>"))
        return etree.tostring(root).decode()

    return retouched(built / ("native" if version == 2 else "fmi3") / "passing.fmu", folder / f"{name}.fmu", change)
