"""Systems of any size: chains of ten different FMUs with ten connections each."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from xml.sax.saxutils import quoteattr

from perilune.fmus_src.export.own_blocks import build_own_blocks
from tests.support.builders import retouched

KINDS = 10
WIDTH = 10  # connections into each component
BLOCK = '''
class Mixer{kind}(Block):
    """Ten outputs, each a tenth of an input more than its own number."""

    share = Parameter({share}, unit="1", description="of the inputs")
    u = Input([0.0] * 10, unit="1", description="inputs")
    y = Output([0.0] * 10, unit="1", description="outputs{direct_words}"{direct})

    def initialize(self) -> None:
        for k in range(10):
            self.y[k] = {kind}.0 + self.share * self.u[k]

    def step(self, t: float, h: float) -> None:
        for k in range(10):
            self.y[k] = {kind}.0 + self.share * self.u[k]
'''


def build_mixers(folder: Path) -> list[Path]:
    """Build ten native FMUs: five that answer at once, five a step later."""
    text = "from perilune import Block, Input, Output, Parameter\n"
    for kind in range(KINDS):
        direct, words = (", direct=True", ", at once") if kind % 2 else ("", "")
        text += BLOCK.format(kind=kind, share=0.05 + 0.01 * kind, direct=direct, direct_words=words)
    file = folder / "mixers.py"
    file.write_text(text)
    return build_own_blocks(file, folder, ["native"], ["linux64"])


def foreign_mixer(fmus: Path, folder: Path) -> Path:
    """Return a folder with the first of the FMUs, changed so that Perilune has not built it."""
    folder.mkdir()
    return retouched(fmus / "mixer0.fmu", folder / "mixer0.fmu", lambda text: f"{text}<!-- foreign -->").parent


def wide_fmu(fmus: Path, path: Path, count: int) -> Path:
    """Write a foreign FMU with ``count`` more local variables than the first of the FMUs, all of its first output."""

    def widen(text: str) -> str:
        output = re.search(r'<ScalarVariable name="y\[1\]" valueReference="(\d+)"', text)
        assert output is not None
        more = (
            f'<ScalarVariable name="v[{k}]" valueReference="{output[1]}" causality="local"><Real/></ScalarVariable>\n'
            for k in range(1, count + 1)
        )
        return text.replace("</ModelVariables>", f"{''.join(more)}</ModelVariables>")

    return retouched(fmus / "mixer0.fmu", path, widen)


def large_system(path: Path, fmus: Path, count: int) -> Path:
    """Write a folder of ``count`` components, the FMUs in turn, each fed with WIDTH connections by the one before it.

    ``fmus`` has some of the FMUs of `build_mixers`, the first ones.
    """
    kinds = len(list(fmus.glob("*.fmu")))
    path.mkdir(parents=True)
    shutil.copytree(fmus, path / "resources")
    numbers = range(1, WIDTH + 1)
    connectors = "".join(
        f'<ssd:Connector name="{name}[{k}]" kind="{kind}"><ssc:Real unit="1"/></ssd:Connector>'
        for name, kind in (("u", "input"), ("y", "output"))
        for k in numbers
    )
    components = (
        f'<ssd:Component name="c{n}" type="application/x-fmu-sharedlibrary" implementation="CoSimulation" '
        f"source={quoteattr(f'resources/mixer{n % kinds}.fmu')}><ssd:Connectors>{connectors}</ssd:Connectors>"
        "</ssd:Component>\n"
        for n in range(count)
    )
    connections = (
        f'<ssd:Connection startElement="c{(n or count) - 1}" startConnector="y[{k}]" '
        f'endElement="c{n}" endConnector="u[{k}]"/>\n'
        for n in range(count)
        for k in numbers
    )
    (path / "SystemStructure.ssd").write_text(
        '<?xml version="1.0" encoding="UTF-8"?>\n<ssd:SystemStructureDescription version="1.0" name="large" '
        'xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription" '
        'xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon"><ssd:System name="large">'
        f"<ssd:Elements>{''.join(components)}</ssd:Elements>"
        f"<ssd:Connections>{''.join(connections)}</ssd:Connections></ssd:System>"
        '<ssd:DefaultExperiment startTime="0" stopTime="0.1"/></ssd:SystemStructureDescription>\n'
    )
    return path
