"""Complete systems of FMI 3.0 FMUs in a container of the FMU Manipulation Toolbox: the bits of `--algorithm jacobi`.

The container consists of the components and connections of the exported .ssp, with complete arrays and with start
values of the FMUs instead of parameter sets. It is itself an FMU of FMI 3.0, which FMPy and Perilune simulate.
"""

import json
import logging
import zipfile

import fmpy
import numpy as np
import pytest
from lxml import etree

import perilune
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.ssp_package import SSD_NAMESPACE
from tests.support.builders import write_zip
from tests.support.fmi3.tables import columns
from tests.support.lengths import either

assembly = pytest.importorskip("fmu_manipulation_toolbox.assembly")
pytestmark = pytest.mark.skipif(local_platform(3) is None, reason="FMI 3.0 libraries are not compiled for this system")
STEPS = 200
SYSTEMS = {"lunar_terminal_guidance": 0.125, "orbital_attitude": 0.2, "satellite_pointing": 0.05}  # s, steps
FLOWN = list(SYSTEMS)[: either(3, 1)]
SSD = f"{{{SSD_NAMESPACE}}}"


@pytest.fixture(autouse=True)
def quiet():
    logging.getLogger("fmu_manipulation_toolbox").setLevel(logging.ERROR)


def without_parameters(exported, path):
    """Return the exported system without parameter bindings and evidence; its description, its files."""
    with zipfile.ZipFile(exported) as archive:
        files = {name: archive.read(name) for name in archive.namelist() if not name.startswith("extra/")}
    root = etree.fromstring(files["SystemStructure.ssd"])
    for bindings in root.findall(f".//{SSD}ParameterBindings"):
        bindings.getparent().remove(bindings)
    files["SystemStructure.ssd"] = etree.tostring(root)
    write_zip(path, files)
    return root, files


def make_container(folder, root, files, step):
    """Write the container of a description: its FMUs by component, each connection as a link."""
    components = {each.get("name"): files[each.get("source")] for each in root.iter(f"{SSD}Component")}
    for name, content in components.items():
        (folder / f"{name}.fmu").write_bytes(content)
    ends = ("startElement", "startConnector", "endElement", "endConnector")
    wires = [[each.get(end) for end in ends] for each in root.iter(f"{SSD}Connection")]
    links = [[f"{start}.fmu", out, f"{end}.fmu", into] for start, out, end, into in wires if start and end]
    assert all(each.get("startIndices") is None for each in root.iter(f"{SSD}Connection"))
    options = {"auto_link": False, "auto_local": True, "auto_input": True, "auto_output": True}
    described = {"fmu": [f"{name}.fmu" for name in components], "step_size": step, "link": links, **options}
    (folder / "container.json").write_text(json.dumps(described))
    assembly.Assembly("container.json", fmu_directory=folder, default_step_size=step).make_fmu(fmi_version=3)
    return folder / "container.fmu"


@pytest.mark.parametrize("name", FLOWN)
def test_a_system_in_a_container(name, tmp_path):
    step = SYSTEMS[name]
    perilune.export(name, fmi=3, platforms=[local_platform(3)], output=tmp_path / "exported.ssp")
    root, files = without_parameters(tmp_path / "exported.ssp", tmp_path / "bare.ssp")
    container = make_container(tmp_path, root, files, step)
    options = {"step": step, "stop_time": STEPS * step}
    ours = perilune.simulate(tmp_path / "bare.ssp", algorithm="jacobi", open_inputs="start", **options)
    variables = fmpy.read_model_description(str(container), validate=False).modelVariables
    record = [each.name for each in variables if each.causality in ("output", "local")]
    theirs = perilune.simulate(container, record=record, **options)
    by_fmpy = columns(
        "container",
        fmpy.simulate_fmu(
            str(container),
            validate=False,
            output=record,
            output_interval=step,
            **{"step_size": step, "stop_time": STEPS * step},
        ),
    )
    compared = set()
    for signal, samples in ours.signals.items():
        element = signal[len(signal.partition("[")[0]) :]
        inside = signal.partition("[")[0].partition(".")[2]
        for inner in (f"container.{signal}", f"container.{inside}{element}"):
            if inner in theirs.signals:
                assert np.array_equal(theirs.signals[inner], samples, equal_nan=True), signal
                assert np.array_equal(by_fmpy[inner], samples, equal_nan=True), signal
                compared.add(signal)
                break
    outputs = {
        f"{each.getparent().getparent().get('name')}.{each.get('name')}"
        for each in root.iter(f"{SSD}Connector")
        if each.get("kind") == "output" and each.getparent().getparent().tag == f"{SSD}Component"
    }
    assert outputs <= {signal.partition("[")[0] for signal in compared}
