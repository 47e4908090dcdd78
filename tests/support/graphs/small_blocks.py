"""Random systems of the blocks of builders.py: connections, faults, tunable parameters, records, algorithm."""

from hypothesis import strategies as st

from perilune.analysis.options.fault import Fault
from tests.support.builders import component, connection, document, system

# Blocks of tests/support/builders.py: connectors by type, and the inputs that an output follows at once.
REAL_INPUTS = {"gain": ["u"], "delay": ["u"], "cross": ["a", "b"], "careful": ["u"]}
REAL_OUTPUTS = {"ramp": ["y"], "gain": ["y"], "delay": ["y"], "cross": ["ya", "yb"], "careful": ["y"], "trouble": ["y"]}
TUNABLE = {"ramp": ["slope", "flag_at"], "gain": ["factor"]}
KINDS = ["ramp", "gain", "delay", "cross", "careful", "whole", "trouble"]
FACTORS = st.sampled_from([1.0, -2.5, 1e-3])
BENT = '<ssc:LinearTransformation factor="{}" offset="{}"/>'
MAPPED = (
    '<ssc:IntegerMappingTransformation><ssc:MapEntry source="{}" target="7"/><ssc:MapEntry source="1" target="-2"/>'
    '<ssc:MapEntry source="2" target="0"/></ssc:IntegerMappingTransformation>'
)
NEGATED = (
    '<ssc:BooleanMappingTransformation><ssc:MapEntry source="true" target="false"/>'
    '<ssc:MapEntry source="false" target="true"/></ssc:BooleanMappingTransformation>'
)


def draw_fault(draw, name, kind, start):
    """Draw a fault that its connector or parameter can have: of flag_at, an Integer, a whole number from 0 on."""
    amount = draw(st.sampled_from([0.0, 2.0, 3.0]) if name.endswith(".flag_at") else FACTORS)
    return Fault(name, kind, 0.0 if kind == "freeze" else amount, start, start + 0.7)


@st.composite
def graphs(draw):
    """Draw components with connections from those before them: an SSD, faults, recorded signals, the algorithm."""
    kinds = ["ramp", *draw(st.lists(st.sampled_from(KINDS), min_size=1, max_size=7))]
    reals, elements, wires, connectors = [], [], [], []
    for number, kind in enumerate(kinds):
        name = f"{kind}{number}"
        declared = []
        for port in REAL_INPUTS.get(kind, ()):
            declared.append(f"input {port} Real m")
            bent = BENT.format(draw(FACTORS), draw(FACTORS)) if draw(st.booleans()) else ""
            wires.append(connection(draw(st.sampled_from(reals)), f"{name}.{port}", bent))
            connectors.append(f"{name}.{port}")
        if kind == "whole":
            declared += ["input n Integer", "input b Boolean", "output m Integer", "output c Boolean"]
            mapped = MAPPED.format(draw(st.integers(3, 9))) if draw(st.booleans()) else ""
            wires.append(connection("ramp0.count", f"{name}.n", mapped))
            wires.append(connection("ramp0.flag", f"{name}.b", NEGATED if draw(st.booleans()) else ""))
        if kind == "ramp":
            declared += ["output count Integer", "output flag Boolean"]
        declared += [f"output {port} Real m" for port in REAL_OUTPUTS.get(kind, ())]
        reals += [f"{name}.{port}" for port in REAL_OUTPUTS.get(kind, ())]
        elements.append(component(name, kind, "; ".join(declared)))
    values = {f"{kind}{n}.kind": draw(st.integers(0, 3)) for n, kind in enumerate(kinds) if kind == "trouble"}
    tunable = [f"{kind}{n}.{name}" for n, kind in enumerate(kinds) for name in TUNABLE.get(kind, ())]
    connectors += reals
    faults = [
        draw_fault(draw, draw(st.sampled_from(connectors) | st.sampled_from(tunable)), kind, start)
        for kind, start in draw(
            st.lists(
                st.tuples(st.sampled_from(["override", "bias", "freeze"]), st.sampled_from([0.0, 0.25, 0.5])),
                max_size=3,
            )
        )
    ]
    wanted = draw(st.none() | st.lists(st.sampled_from(reals), unique=True, max_size=3))
    ssd = document(system(*elements, connections="".join(wires)), stop=2.0)
    return ssd, values, faults, wanted, draw(st.sampled_from(["sequential", "jacobi"]))
