"""Systems with a declared bound of their landing: the lunar landing with an inserted annotation."""

import shutil

from perilune.common.paths import SYSTEMS

ROLES = {
    "position": "plant.initial_position",
    "velocity": "plant.initial_velocity",
    "mass": "plant.initial_mass",
    "dry_mass": "440",
    "specific_impulse": "plant.specific_impulse",
    "maximum_thrust": "allocation.maximum_thrust",
    "moon_radius": "plant.moon_radius",
    "gravitational_parameter": "plant.gravitational_parameter",
    "target_altitude": "4",
}
ANNOTATION = """<ssc:Annotation type="org.perilune.bound">
      <Bound xmlns="https://perilune.org/bound" {}>{}</Bound>
    </ssc:Annotation>
    <ssc:Annotation type="org.perilune.stability">"""
PIECES = """
<Stop name="braking" altitude="2400"/>
<Hover name="transfer" mass="526.37" minimum_thrust="allocation.minimum_thrust" start_altitude="2400"
       end_altitude="100" aside="plant.initial_velocity"/>"""
START = """<?xml version="1.0" encoding="UTF-8"?>
<ssv:ParameterSet version="1.0" name="higher" xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues">
  <ssv:Parameters>
    <ssv:Parameter name="plant.initial_mass"><ssv:Real value="930"/></ssv:Parameter>
  </ssv:Parameters>
</ssv:ParameterSet>
"""


def declared_system(folder, pieces="", **roles):
    """Copy the lunar landing to a folder, with an SSD that declares a bound; roles that are None are left out."""
    collected = {name: value for name, value in (ROLES | roles).items() if value is not None}
    place = folder / "landing"
    shutil.copytree(SYSTEMS / "lunar_landing", place)
    (place / "lighter.ssv").write_text(START)
    ssd = place / "SystemStructure.ssd"
    words = " ".join(f'{name}="{value}"' for name, value in collected.items())
    text = ssd.read_text(encoding="utf-8")
    before = '<ssc:Annotation type="org.perilune.stability">'
    assert text.count(before) == 1
    ssd.write_text(text.replace(before, ANNOTATION.format(words, pieces)), encoding="utf-8")
    return place
