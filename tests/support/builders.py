"""Tiny FMUs with known behaviour, and system descriptions in short form.

The FMUs are built from a file outside the repository, as a user's would be. Their declarations can be rewritten
(`retouched`) into forms that Perilune's blocks never use: enumerations, units with a factor, model exchange.
"""

from __future__ import annotations

import re
import shutil
import textwrap
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import fmpy
from pythonfmu import FmuBuilder

from perilune.analysis.runtime.flight.results import FlightResult
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.paths import FLAVOURS
from perilune.fmus_src.export.own_blocks import build_own_blocks

BLOCKS = '''
from perilune.fmus_src.block import Block, Input, Output, Parameter, State


class Ramp(Block):
    """Source: y rises by slope a second from start; steps are counted, the flag is up from step `flag_at` on."""

    start = Parameter(1.0, unit="m", description="y at the start")
    slope = Parameter(2.0, unit="m/s", description="rise of y")
    flag_at = Parameter(1000000, minimum=0, description="step at which the flag goes up")
    first_count = Parameter(0, description="count at the start")
    inverted = Parameter(False, description="flag down where it would be up")
    y = Output(0.0, unit="m", description="ramp")
    count = Output(0, description="steps taken")
    flag = Output(False, description="up from step flag_at on")
    steps = State(0, description="steps taken")

    def initialize(self) -> None:
        self.y = self.start
        self.count = self.first_count
        self.flag = (self.flag_at <= 0) != self.inverted

    def step(self, t: float, h: float) -> None:
        self.steps = self.steps + 1
        self.y = self.y + self.slope * h
        self.count = self.count + 1
        self.flag = (self.steps >= self.flag_at) != self.inverted


class Angle(Block):
    """Source: an angle that does not change."""

    start = Parameter(1.0, unit="rad", description="the angle")
    y = Output(0.0, unit="rad", description="the angle")

    def initialize(self) -> None:
        self.y = self.start

    def step(self, t: float, h: float) -> None:
        self.y = self.start


class Gain(Block):
    """y = factor * u at the same time."""

    factor = Parameter(3.0, unit="1", description="factor", minimum=-100.0, maximum=100.0)
    u = Input(0.0, unit="m", description="input")
    y = Output(0.0, unit="m", direct=True, description="output")

    def initialize(self) -> None:
        self.y = self.factor * self.u

    def step(self, t: float, h: float) -> None:
        self.y = self.factor * self.u


class Delay(Block):
    """y is u of one step ago."""

    start = Parameter(5.0, unit="m", description="y at the start")
    u = Input(7.0, unit="m", description="input")
    y = Output(0.0, unit="m", description="output")

    def initialize(self) -> None:
        self.y = self.start

    def step(self, t: float, h: float) -> None:
        self.y = self.u


class Careful(Block):
    """A source that cannot be initialised on an input of zero, though its output does not depend on it."""

    u = Input(1.0, unit="m", description="input, never zero")
    y = Output(0.0, unit="m", description="input of one step ago")
    scale = State(0.0, unit="1", description="one over the first input")

    def initialize(self) -> None:
        self.scale = 1.0 / self.u
        self.y = 4.0

    def step(self, t: float, h: float) -> None:
        self.y = self.u


class Cross(Block):
    """Two gains in one: ya depends on a only, yb on b only."""

    a = Input(0.25, unit="m", description="input")
    b = Input(0.5, unit="m", description="input")
    ya = Output(0.0, unit="m", direct=("a",), description="2 a")
    yb = Output(0.0, unit="m", direct=("b",), description="b + 1")

    def initialize(self) -> None:
        self.ya = 2.0 * self.a
        self.yb = self.b + 1.0

    def step(self, t: float, h: float) -> None:
        self.ya = 2.0 * self.a
        self.yb = self.b + 1.0


class Whole(Block):
    """Passes an Integer and a Boolean on."""

    n = Input(0, description="input")
    b = Input(False, description="input")
    m = Output(0, direct=True, description="n")
    c = Output(False, direct=True, description="b")

    def initialize(self) -> None:
        self.m = self.n
        self.c = self.b

    def step(self, t: float, h: float) -> None:
        self.m = self.n
        self.c = self.b


class Trouble(Block):
    """A source that goes wrong at a step: 1 divides by zero, 2 puts out infinity, 3 NaN; 4 fails at the start."""

    kind = Parameter(0, description="how it goes wrong")
    at = Parameter(3, description="step at which it does")
    steps = State(0, description="steps taken")
    y = Output(1.0, unit="m", description="good until then")

    def initialize(self) -> None:
        self.y = 1.0
        if self.kind == 4:
            self.y = 1.0 / 0.0

    def step(self, t: float, h: float) -> None:
        self.steps = self.steps + 1
        self.y = self.y + 1.0
        if self.steps == self.at:
            if self.kind == 1:
                self.y = self.y / 0.0
            if self.kind >= 2:
                self.y = 1e308 * 10.0
            if self.kind == 3:
                self.y = self.y - self.y
'''

# A stock pythonfmu FMU: no units, no dependencies (so stepped without a lead), a String parameter.
STRANGER = """
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real, String


class Stranger(Fmi2Slave):
    def __init__(self, **keywords):
        super().__init__(**keywords)
        self.u, self.y, self.word, self.length = 2.0, 0.0, "one", 0.0
        self.register_variable(Real("u", causality=Fmi2Causality.input))
        self.register_variable(Real("y", causality=Fmi2Causality.output))
        self.register_variable(
            String("word", causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable)
        )
        self.register_variable(Real("length", causality=Fmi2Causality.output))

    def exit_initialization_mode(self):
        self.length, self.y = float(len(self.word)), self.u + 1.0

    def do_step(self, current_time, step_size):
        self.length, self.y = float(len(self.word)), self.u + 1.0
        return True
"""

UNITS = """<ssd:Units>
<ssc:Unit name="1"><ssc:BaseUnit/></ssc:Unit>
<ssc:Unit name="m"><ssc:BaseUnit m="1"/></ssc:Unit>
<ssc:Unit name="km"><ssc:BaseUnit m="1" factor="1000"/></ssc:Unit>
<ssc:Unit name="s"><ssc:BaseUnit s="1"/></ssc:Unit>
<ssc:Unit name="m/s"><ssc:BaseUnit m="1" s="-1"/></ssc:Unit>
<ssc:Unit name="rad"><ssc:BaseUnit rad="1"/></ssc:Unit>
<ssc:Unit name="deg"><ssc:BaseUnit rad="1" factor="0.017453292519943295"/></ssc:Unit>
<ssc:Unit name="K"><ssc:BaseUnit K="1"/></ssc:Unit>
<ssc:Unit name="degC"><ssc:BaseUnit K="1" offset="273.15"/></ssc:Unit>
<ssc:Unit name="degF"><ssc:BaseUnit K="1" factor="0.5555555555555556" offset="255.3722222222222"/></ssc:Unit>
</ssd:Units>"""
NAMESPACES = """xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
 xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon"
 xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues"
 xmlns:ssm="http://ssp-standard.org/SSP1/SystemStructureParameterMapping"
 xmlns:ssb="http://ssp-standard.org/SSP1/SystemStructureSignalDictionary\""""


def build_tiny_fmus(folder: Path) -> None:
    """Build the FMUs above into ``folder``/FLAVOUR, with retouched ones next to them."""
    folder.mkdir(parents=True, exist_ok=True)
    blocks = folder / "tiny_blocks.py"
    blocks.write_text(BLOCKS)
    build_own_blocks(blocks, folder, FLAVOURS, [fmpy.platform])
    script = folder / "stranger.py"
    script.write_text(STRANGER)
    FmuBuilder.build_FMU(script, folder)
    for flavour in FLAVOURS:
        shutil.copy(folder / "Stranger.fmu", folder / flavour / "stranger.fmu")
        retouch_tiny_fmus(folder / flavour)


def retouch_tiny_fmus(folder: Path) -> None:
    """Write variants of the FMUs with declarations that our own blocks never have."""

    def enumerate_integers(text: str) -> str:
        items = "".join(f'<Item name="{name}" value="{value}"/>' for name, value in MODES.items())
        types = f'<TypeDefinitions><SimpleType name="Mode"><Enumeration>{items}</Enumeration></SimpleType>'
        text = text.replace("<LogCategories>", f"{types}</TypeDefinitions><LogCategories>")
        return re.sub(r"<Integer([^>]*?)/>", r'<Enumeration declaredType="Mode"\1/>', text)

    def in_kilometres(text: str) -> str:
        text = text.replace('<BaseUnit m="1"/>', '<BaseUnit m="1" factor="1000"/>')
        return text.replace('name="m"', 'name="km"').replace('unit="m"', 'unit="km"')

    def in_degrees(text: str) -> str:
        text = text.replace('<BaseUnit rad="1"/>', '<BaseUnit rad="1" factor="0.017453292519943295"/>')
        return text.replace('name="rad"', 'name="deg"').replace('unit="rad"', 'unit="deg"')

    retouched(folder / "whole.fmu", folder / "mode.fmu", enumerate_integers)
    retouched(folder / "ramp.fmu", folder / "mode_ramp.fmu", enumerate_integers)
    retouched(folder / "gain.fmu", folder / "kilometre_gain.fmu", in_kilometres)
    retouched(folder / "angle.fmu", folder / "degree_angle.fmu", in_degrees)


MODES = {"idle": 1, "brake": 2, "hover": 7}


def retouched(source: Path, target: Path, change: Any) -> Path:
    """Write the FMU with another modelDescription.xml: ``change`` maps its text."""
    with zipfile.ZipFile(source) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    files["modelDescription.xml"] = change(files["modelDescription.xml"].decode()).encode()
    return write_zip(target, files)


def write_zip(path: Path, files: Mapping[str, bytes | str]) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return path


def connectors(text: str) -> str:
    """Return connectors of ``output y Real m; input u Integer``: kind, name, type and unit; an
    Enumeration is named by its unit."""
    collected = []
    for part in filter(None, (piece.strip() for piece in text.split(";"))):
        kind, name, type_name, *unit = part.split()
        attribute = "name" if type_name == "Enumeration" else "unit"
        inner = f"<ssc:{type_name}{f' {attribute}={chr(34)}{unit[0]}{chr(34)}' if unit else ''}/>"
        collected.append(
            f'<ssd:Connector name="{name}" kind="{kind}">{inner if type_name != "-" else ""}</ssd:Connector>'
        )
    return f"<ssd:Connectors>{''.join(collected)}</ssd:Connectors>" if collected else ""


def component(name: str, fmu: str, declared: str = "", bindings: str = "", attributes: str = "") -> str:
    """Return a component; ``bindings`` are ParameterBinding elements."""
    source = f'source="resources/{fmu}.fmu"' if "." not in fmu else f'source="resources/{fmu}"'
    return f'<ssd:Component name="{name}" {source} {attributes}>{connectors(declared)}{bound(bindings)}</ssd:Component>'


def bound(bindings: str) -> str:
    return f"<ssd:ParameterBindings>{bindings}</ssd:ParameterBindings>" if bindings else ""


def connection(start: str, end: str, inner: str = "", attributes: str = "") -> str:
    """Return a connection, ``connection("ramp.y", "gain.u")``; a name without a dot is a
    connector of the system itself."""
    ends = []
    for side, name in (("start", start), ("end", end)):
        element, dot, connector = name.partition(".")
        ends.append(
            f'{side}Element="{element}" {side}Connector="{connector}"' if dot else f'{side}Connector="{element}"'
        )
    return f"<ssd:Connection {' '.join(ends)} {attributes}>{inner}</ssd:Connection>"


def system(
    *elements: str, connections: str = "", declared: str = "", bindings: str = "", name: str = "root", extra: str = ""
) -> str:
    """Return a System element; ``extra`` follows its connections."""
    wires = f"<ssd:Connections>{connections}</ssd:Connections>" if connections else ""
    inside = f"<ssd:Elements>{''.join(elements)}</ssd:Elements>" if elements else ""
    return f'<ssd:System name="{name}">{connectors(declared)}{bound(bindings)}{inside}{wires}{extra}</ssd:System>'


def document(root: str, stop: float | None = 1.0, step: float | None = 0.25, more: str = "", units: str = UNITS) -> str:
    """Return an SSD; ``more`` stands between system and units, for instance enumerations."""
    note = (
        '<ssd:Annotations><ssc:Annotation type="org.perilune.step">'
        f'<CommunicationStep xmlns="https://perilune.org/step" size="{step}"/></ssc:Annotation></ssd:Annotations>'
    )
    times = f'<ssd:DefaultExperiment startTime="0" stopTime="{stop}">{note if step is not None else ""}'
    experiment = f"{times}</ssd:DefaultExperiment>" if stop is not None else ""
    return (
        f'<ssd:SystemStructureDescription version="1.0" name="test" {NAMESPACES}>\n'
        f"{root}\n{more}{units}{experiment}</ssd:SystemStructureDescription>\n"
    )


def inline(values: str, prefix: str = "", mapping: str = "") -> str:
    """Return a ParameterBinding with values ``name=Type:value[ unit]`` separated by semicolons."""
    return (
        f'<ssd:ParameterBinding prefix="{prefix}"><ssd:ParameterValues>{parameter_set(values)}</ssd:ParameterValues>'
        f"{mapping}</ssd:ParameterBinding>"
    )


def external(source: str, prefix: str = "", mapping: str = "") -> str:
    """Return a ParameterBinding to a file."""
    return f'<ssd:ParameterBinding source="{source}" prefix="{prefix}">{mapping}</ssd:ParameterBinding>'


def parameter_set(values: str) -> str:
    """Return an ssv:ParameterSet, complete with namespaces and units."""
    collected = []
    for part in filter(None, (piece.strip() for piece in values.split(";"))):
        name, _, remainder = part.partition("=")
        type_name, _, value = remainder.partition(":")
        value, _, unit = value.partition(" ")
        unit = f' unit="{unit}"' if unit else ""
        collected.append(f'<ssv:Parameter name="{name}"><ssv:{type_name} value="{value}"{unit}/></ssv:Parameter>')
    units = UNITS.replace("ssd:Units", "ssv:Units")
    return (
        f'<ssv:ParameterSet version="1.0" name="set" {NAMESPACES}>'
        f"<ssv:Parameters>{''.join(collected)}</ssv:Parameters>{units}</ssv:ParameterSet>"
    )


def mapping(entries: str) -> str:
    """Return an ssm:ParameterMapping around its MappingEntry elements."""
    return f'<ssm:ParameterMapping version="1.0" {NAMESPACES}>{entries}</ssm:ParameterMapping>'


def inline_mapping(entries: str) -> str:
    return f"<ssd:ParameterMapping>{mapping(entries)}</ssd:ParameterMapping>"


def pack(path: Path, fmus: Path, ssd: str, **files: str | bytes) -> Path:
    """Write an .ssp of the description, the FMUs of ``fmus`` that it names, and further files.

    Names of ``files`` are archive names with ``__`` for a dot and ``___`` for a slash.
    """
    content: dict[str, str | bytes] = {"SystemStructure.ssd": ssd}
    for name, text in files.items():
        content[name.replace("___", "/").replace("__", ".")] = text
    texts = [text for text in content.values() if isinstance(text, str)]
    for source in sorted(set(re.findall(r'resources/(\w+)\.fmu"', "".join(texts)))):
        if f"resources/{source}.fmu" not in content and (fmus / f"{source}.fmu").is_file():
            content[f"resources/{source}.fmu"] = (fmus / f"{source}.fmu").read_bytes()
    return write_zip(path, content)


def fly(path: Path, faults: Any = (), **options: Any) -> FlightResult:
    """Fly a packed system; the result's arrays are its own."""
    with Simulation(prepare_system(path, SystemOptions(**options)), faults=faults) as simulation:
        result = simulation.fly()
    result.signals = {name: values.copy() for name, values in result.signals.items()}
    return result


def dedented(text: str) -> str:
    return textwrap.dedent(text).strip() + "\n"
