"""SSP 2.0 in the form written by OMSimulator: it runs, with one line for each violation of the schema.

OMSimulator writes Real and Integer, an empty element for the system itself, parameter sets inside components, metadata
of components, and values and times with Python's `str`. Truth: the ramp and the gain by hand; the schemas of SSP 2.0.
"""

import numpy as np
import pytest

from perilune.common.errors import InputError
from tests.support.builders import NAMESPACES, fly, pack

METADATA = '<ssc:MetaData kind="general" type="application/x-uncertainty-quantification" source="resources/od.xml"/>'
TRANSFORMATION = '<ssc:LinearTransformation factor="2.0" offset="0.0"/>'
GEOMETRY = '<ssd:ConnectionGeometry pointsX="1.0" pointsY="2.0"/>'
BINDING = """<ssd:ParameterBindings>
  <ssd:ParameterBinding>
    <ssd:ParameterValues>
      <ssv:ParameterSet version="2.0" name="parameters">
        <ssv:Parameters>
          <ssv:Parameter name="start" description="y at the start"><ssv:Real value="4.0" unit="m"/></ssv:Parameter>
          <ssv:Parameter name="flag_at"><ssv:Integer value="2"/></ssv:Parameter>
          <ssv:Parameter name="inverted"><ssv:Boolean value="false"/></ssv:Parameter>
        </ssv:Parameters>
        <ssv:Units><ssc:Unit name="m"><ssc:BaseUnit m="1"/></ssc:Unit></ssv:Units>
      </ssv:ParameterSet>
    </ssd:ParameterValues>
  </ssd:ParameterBinding>
</ssd:ParameterBindings>"""
TEXT = f"""<?xml version='1.0' encoding='UTF-8'?>
<ssd:SystemStructureDescription {NAMESPACES} name="default" version="2.0" generationTool="OMSimulator v3.0.0"
  generationDateAndTime="2026-06-01T10:20:30.123456">
  <ssd:System name="default">
    <ssd:Connectors>
      <ssd:Connector name="out" kind="output"><ssc:Real unit="m"/></ssd:Connector>
    </ssd:Connectors>
    <ssd:Elements>
      <ssd:Component name="ramp" type="application/x-fmu-sharedlibrary" source="resources/ramp.fmu">
        <ssd:Connectors>
          <ssd:Connector name="y" kind="output" description="ramp">
            <ssc:Real unit="m"/><ssd:ConnectorGeometry x="1.0" y="0.5"/>
          </ssd:Connector>
          <ssd:Connector name="start" kind="parameter"><ssc:Real unit="m"/></ssd:Connector>
        </ssd:Connectors>
        <ssd:ElementGeometry x1="0.0" y1="0.0" x2="10.0" y2="10.0"/>
        {BINDING}
        {METADATA}
      </ssd:Component>
      <ssd:Component name="gain" type="application/x-fmu-sharedlibrary" source="resources/gain.fmu">
        <ssd:Connectors>
          <ssd:Connector name="u" kind="input"><ssc:Real unit="m"/></ssd:Connector>
          <ssd:Connector name="y" kind="output"><ssc:Real unit="m"/></ssd:Connector>
        </ssd:Connectors>
      </ssd:Component>
    </ssd:Elements>
    <ssd:Connections>
      <ssd:Connection startElement="ramp" startConnector="y" endElement="gain" endConnector="u"/>
      <ssd:Connection startElement="gain" startConnector="y" endElement="" endConnector="out">
        {TRANSFORMATION}{GEOMETRY}
      </ssd:Connection>
    </ssd:Connections>
  </ssd:System>
  <ssd:Units><ssc:Unit name="m"><ssc:BaseUnit m="1" factor="1.0" offset="0.0"/></ssc:Unit></ssd:Units>
  <ssd:DefaultExperiment startTime="0.0" stopTime="1.0"/>
</ssd:SystemStructureDescription>
"""


def test_it_runs(tiny, tmp_path):
    run = fly(pack(tmp_path / "s.ssp", tiny, TEXT), step=0.25)
    ramp = 4.0 + 2.0 * run.time
    np.testing.assert_array_equal(run["ramp.y"], ramp)
    np.testing.assert_array_equal(run["out"], 2.0 * 3.0 * ramp)
    np.testing.assert_array_equal(run["ramp.flag"], [0, 0, 1, 1, 1])


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('value="false"', 'value="False"', r"line \d+: not valid SSP 2\.0: .*'False' is not a valid"),
        (
            TRANSFORMATION + GEOMETRY,
            GEOMETRY + TRANSFORMATION,
            r"line \d+: not valid SSP 2\.0: .*LinearTransformation.*not expected",
        ),
        (BINDING, BINDING + BINDING, r"line \d+: not valid SSP 2\.0: .*ParameterBindings.*not expected"),
        ('kind="general"', "", r"line \d+: not valid SSP 2\.0: .*kind"),
    ],
)
def test_where_the_schema_is_broken_one_line_says_so(tiny, tmp_path, old, new, words):
    assert old in TEXT
    with pytest.raises(InputError, match=words) as refusal:
        fly(pack(tmp_path / "s.ssp", tiny, TEXT.replace(old, new, 1)), step=0.25)
    assert "\n" not in refusal.value.text
