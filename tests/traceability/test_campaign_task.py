"""`perilune batch --trace`: requirement, draws, models, trials and verdict of a campaign in one document.

Truth: the folder's files, digested by hashlib; the summary of the same batch.
"""

import hashlib
import importlib.util
import json
from pathlib import Path
from urllib.parse import unquote

import pytest
from lxml import etree

import perilune
from perilune.analysis.cli import main
from perilune.analysis.traceability.elements import NAMESPACES

SYSTEM = "lunar_terminal_guidance"
FEW = f"""
system = "{SYSTEM}"
trials = 6
seed = 4

[compare]
guidance = ["analytic_guidance", "astar_guidance"]

[draw."plant.initial_position[3]"]
distribution = "uniform"
low = 1e4
high = 1.1e4

[metric.flight_time]
expression = "time"
reduction = "final"

[success]
expression = "flight_time > 0"

[requirement.short]
expression = "flight_time < 1"
share = 0.9
confidence = 0.9
description = "it is not"

[record]
traces = "all"
every = 100
signals = ["plant.position[3]"]
"""


@pytest.fixture(scope="module")
def traced(fmus, tmp_path_factory):
    """Return the folder with a campaign, its output and its task, whose name has a space; the task's root; the
    batch."""
    folder = tmp_path_factory.mktemp("traced")
    (folder / "few.toml").write_text(FEW)
    command = ["batch", SYSTEM, "--campaign", str(folder / "few.toml"), "--output", str(folder / "in flight")]
    assert main([*command, "--trace", str(folder / "task.stmd")]) == 1  # no trial is that short
    root = etree.parse(folder / "task.stmd").getroot()
    return folder, root, json.loads((folder / "in flight" / "summary.json").read_text())


def steps(root):
    return [etree.QName(step).localname for phase in root for step in phase]


def test_its_steps(traced):
    assert steps(traced[1]) == [
        "DefineTestCaseRequirements",
        "ImplementParameter",
        "IntegrateSimulation",
        "ExecuteSimulation",
        "EvaluateSimulationResults",
        "DecideSimulationObjectiveFulfillment",
    ]
    assert traced[1].get("name") == f"{SYSTEM}: few"


def test_every_file_with_its_digest(traced):
    """All files of the folder but its lock, each described once."""
    folder, root, _ = traced
    described = {}
    for resource in root.iterfind(".//stc:Resource[@source]", NAMESPACES):
        path = folder / unquote(resource.get("source"))
        (document,) = resource.iterfind("stc:MetaData/stc:Content/srmd:SimulationResourceMetaData", NAMESPACES)
        assert document.get("checksum") == hashlib.sha3_256(path.read_bytes()).hexdigest()
        assert document.get("data") == resource.get("source")
        described.setdefault(path, resource.get("kind"))
    expected = {path for path in (folder / "in flight").rglob("*") if path.is_file() and path.name != ".lock"}
    assert set(described) == expected
    kinds = {path.suffix: kind for path, kind in described.items()}
    assert (kinds[".ssd"], kinds[".fmu"], kinds[".ssv"]) == ("system", "model", "parameter")
    assert described[folder / "in flight" / "draws.parquet"] == "parameter"
    references = root.iterfind(".//stc:ResourceReference", NAMESPACES)
    targets = {reference.get(f"{{{NAMESPACES['xlink']}}}href").removeprefix("#") for reference in references}
    assert targets <= {resource.get("id") for resource in root.iterfind(".//stc:Resource", NAMESPACES)}


def entries(root, name):
    path = f".//stc:Classification[@type='{name}']/stc:ClassificationEntry"
    return {entry.get("keyword"): entry.text for entry in root.iterfind(path, NAMESPACES)}


def test_requirements_and_verdicts(traced):
    _, root, summary = traced
    assert entries(root, "org.perilune.requirements") == {
        "short": "flight_time < 1, 90 % probability at 90 % confidence"
    }
    verdicts = entries(root, "org.perilune.verdicts")
    assert set(verdicts) == {"analytic_guidance.short", "astar_guidance.short"}
    stored = summary["variants"]["analytic_guidance"]["requirements"]["short"]["verdict"]
    assert verdicts["analytic_guidance.short"].startswith(f"{stored}: ")
    assert verdicts["analytic_guidance.short"].endswith("; 6 failures in 6 trials")
    assert entries(root, "org.perilune.draws") == {"seed": "4", "trials": "6"}
    assert entries(root, "org.perilune.success_rate")["astar_guidance"] == "1 of 6 trials"


def test_the_same_bytes_again(traced, tmp_path):
    folder, _, _ = traced
    created = perilune.batch(SYSTEM, folder / "few.toml", output=folder / "in flight", resume=True)
    created.write_task(folder / "again.stmd")
    assert (folder / "again.stmd").read_bytes() == (folder / "task.stmd").read_bytes()


def test_without_a_folder(traced, tmp_path, capsys, refusal):
    few = str(traced[0] / "few.toml")
    assert main(["batch", SYSTEM, "--campaign", few, "--trace", str(tmp_path / "x.stmd")]) == 2
    assert "--trace: " in (message := capsys.readouterr().err)
    assert "has no effect unless --output is given" in message
    assert ".stmd" in refusal(["batch", SYSTEM, "--campaign", few, "--output", str(tmp_path), "--trace", "x.xml"])
    assert list(tmp_path.iterdir()) == []


XLINK = """<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" targetNamespace="http://www.w3.org/1999/xlink">
{}</xs:schema>"""
LINK_ATTRIBUTES = ("type", "href", "label", "title", "role", "arcrole", "from", "to")


def standard_schema(name, folder):
    """Return a schema of the standard from the package that carries it, as XSD 1.0: lxml has no 1.1, nor the
    network."""
    source = Path(importlib.util.find_spec("pyssp_standard").origin).parent / "resources"
    for path in source.glob("*.xsd"):
        text = path.read_text(encoding="utf-8").replace("xs:dateTimeStamp", "xs:dateTime")
        (folder / path.name).write_text(text.replace("https://www.w3.org/XML/2008/06/xlink.xsd", "xlink.xsd"))
    attributes = "".join(f'<xs:attribute name="{name}" type="xs:string"/>' for name in LINK_ATTRIBUTES)
    (folder / "xlink.xsd").write_text(XLINK.format(attributes))
    return etree.XMLSchema(etree.parse(folder / name))


def test_the_schemas_of_the_standard(traced, tmp_path):
    """Steps against SSP Traceability Common, documents of resources against SRMD; the package has no schema of STMD."""
    root = traced[1]
    documents = list(root.iter(f"{{{NAMESPACES['srmd']}}}SimulationResourceMetaData"))
    resources = standard_schema("SRMD11.xsd", tmp_path)
    assert len(documents) > 10
    for document in documents:
        resources.assertValid(etree.fromstring(etree.tostring(document)))
    elements = "".join(f'<xs:element name="{name}" type="stc:StepType"/>' for name in dict.fromkeys(steps(root)))
    (tmp_path / "steps.xsd").write_text(
        f'<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" xmlns:stc="{NAMESPACES["stc"]}" '
        f'targetNamespace="{NAMESPACES["stmd"]}">'
        f'<xs:import namespace="{NAMESPACES["stc"]}" schemaLocation="STC11.xsd"/>{elements}</xs:schema>'
    )
    schema = etree.XMLSchema(etree.parse(tmp_path / "steps.xsd"))
    for phase in root:
        for step in phase:
            schema.assertValid(etree.fromstring(etree.tostring(step)))
