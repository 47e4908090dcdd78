"""Good documents that have a little of everything: a system, a parameter set, a mapping, a campaign, inputs."""

from __future__ import annotations

from tests.hostile.campaigns import GOOD
from tests.support.arrays.documents import in_version_2
from tests.support.builders import (
    component,
    connection,
    document,
    external,
    inline,
    inline_mapping,
    mapping,
    parameter_set,
    system,
)
from tests.support.pages.declaring import with_report
from tests.support.refused import GAIN, RAMP, WIRED

MAPPED = inline_mapping(
    '<ssm:MappingEntry source="a" target="ramp.slope">'
    '<ssc:LinearTransformation factor="2" offset="1"/></ssm:MappingEntry>'
)
INNER = system(
    component("gain", "gain", "input u Real m; output y Real m"),
    declared="input in Real km; output out Real m",
    connections=connection("in", "gain.u") + connection("gain.y", "out", "<ssc:LinearTransformation factor='2'/>"),
    name="inner",
)
SCENE = """<Scene title="Here" axes="north west up" up="z"><Surface kind="plane" name="ground of it"/>
<Body name="it" shape="lander" size="1 2 3" at="0 0 1">
<Thrust signal="ramp.y" at="0 0 1" along="0 1 0"/>
<Jets forces="ramp.y" couple="true"><Jet at="1 0 0" along="0 1 0"/></Jets><Panel size="1 1 0.1"/></Body>
<Body name="other" shape="box" size="1 1 1"/>
<Line from="it" to="other" name="beam"/><Line from="it" to="ground" while="ramp.count"/></Scene>"""
WITHOUT_REPORT = document(
    system(
        RAMP,
        GAIN,
        component("whole", "whole", "input n Integer; input b Boolean; output m Integer"),
        INNER,
        connections=WIRED
        + connection("ramp.count", "whole.n")
        + connection("ramp.flag", "whole.b")
        + connection("gain.y", "inner.in"),
        bindings=inline("ramp.start=Real:2 km; ramp.flag_at=Integer:3; ramp.inverted=Boolean:true")
        + inline("a=Real:1", mapping=MAPPED)
        + external("resources/a.ssv"),
    )
)
SSD = with_report(WITHOUT_REPORT, SCENE)
SOURCE = parameter_set("ramp.first_count=Integer:3")
SSV = parameter_set("ramp.start=Real:2 m; ramp.flag_at=Integer:3; a=Boolean:true; b=String:x; c=Enumeration:y")
SSM = mapping(
    '<ssm:MappingEntry source="ramp.start" target="x"/><ssm:MappingEntry source="a" target="y"><ssc:BooleanMapping>'
    '<ssc:MapEntry source="true" target="false"/></ssc:BooleanMapping></ssm:MappingEntry>'
    '<ssm:MappingEntry source="ramp.flag_at" target="z" suppressUnitConversion="true">'
    '<ssc:LinearTransformation factor="2" offset="1"/></ssm:MappingEntry>'
)
ARRAYS = system(
    component("gain", "gain", "input u Float64 m; output y Float64 m"),
    name="arrays",
    declared="structuralParameter n UInt64; input in(n) Float64 km; local same(2) Float64 m; output one Float64",
    bindings=inline("n=UInt64:2"),
    connections=connection("in", "same")
    + connection("in", "gain.u", attributes='startIndices="2"')
    + connection("in", "one", attributes='startIndices="1"'),
)
SIGNED = (
    '<ssc:MetaData kind="quality" type="x/y"><ssc:Content>a</ssc:Content></ssc:MetaData>'
    '<ssc:Signature role="authenticity" type="x/y"/></ssd:SystemStructureDescription>'
)
SSD_2 = in_version_2(
    document(
        system(
            RAMP,
            GAIN,
            ARRAYS,
            declared="structuralParameter n UInt64; parameter p(1,2) Float32; input in(?) Float64 m; output out Int32",
            connections=WIRED
            + connection("n", "arrays.n")
            + connection("in", "arrays.in")
            + connection(
                "ramp.count",
                "out",
                "<ssc:IntegerMappingTransformation><ssc:MapEntry source='1' target='2'/>"
                "</ssc:IntegerMappingTransformation>",
            ),
            bindings=inline("n=UInt64:2; p(1,2)=Float32:1,2; in(2)=Float64:1,2 km; arrays.n=UInt8:3"),
        )
    )
).replace("</ssd:SystemStructureDescription>", SIGNED)
SSV_2 = in_version_2(
    parameter_set("a(2,2)=Float64:1,2,3,4 m; b(3)=Boolean:true,false,1; c=UInt64:5; d=String:x; e(1)=Int8:-5")
).replace('<ssv:String value="x"/>', '<ssv:String><ssv:Value value="x y"/></ssv:String>')
SERIES = "time,gain.u,whole.b\n0,1.5,true\n0.5,-2,False\n0.5,1e3,1\n2,0,0\n"
CAMPAIGN = (
    GOOD
    + """
[derive]
twice = "2 * ramp.slope"
[set]
"ramp.start" = 2.0
[draw."ramp.flag_at"]
distribution = "choice"
values = [1, 2, 3]
weights = [1, 2, 1]
[draw.pair]
distribution = "correlated_normal"
names = ["one", "two"]
mean = [0, 1]
covariance = [[1, 0.5], [0.5, 1]]
[metric.least]
expression = "min(ramp.y, abs(ramp.y) ** 2)"
reduction = "min"
window = [0, 1]
[group]
by = "ramp.flag_at"
[fault.stuck]
connector = "ramp.y"
kind = "bias"
value = "twice"
start = 0.5
[record]
final = ["ramp.y"]
every = 2
signals = ["ramp.y"]
[requirement.high]
expression = "end > 0"
share = 0.5
confidence = 0.9
[scatter.s]
x = "end"
y = "least"
[configuration.a]
use = {}
"""
)
