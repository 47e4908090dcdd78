"""Values exchanged directly through the memory of FMUs.

Truth: the same simulation by FMI calls, to the last bit.
"""

import numpy as np
import pytest

import perilune
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.instances.instance import Instance
from perilune.analysis.runtime.loop import codes
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system

pytestmark = pytest.mark.usefixtures("fmus")
FAULTS = [
    perilune.Fault("plant.position[1]", "bias", 3.0, 5.0, 9.0),
    perilune.Fault("guidance.velocity[2]", "freeze", 0.0, 4.0, 11.0),
    perilune.Fault("guidance.finished", "override", True, 12.0, 13.0),
]


def prepared(system, **options):
    return prepare_system(system, SystemOptions(flavour="native", **options))


def in_memory(simulation):
    """Count the instructions that read or write FMUs' memory."""
    return int(np.isin(simulation.program.instructions[:, codes.CODE], codes.IN_MEMORY).sum())


def assert_same(one, other):
    assert one.status == other.status
    assert one.time.tobytes() == other.time.tobytes()
    for name, values in one.signals.items():
        assert values.tobytes() == other.signals[name].tobytes(), name


@pytest.mark.parametrize(
    ("system", "options", "faults"),
    [
        ("lunar_terminal_guidance", {"stop_time": 30.0}, FAULTS),
        ("lunar_terminal_guidance", {"stop_time": 30.0, "algorithm": "jacobi"}, []),
        ("lunar_landing", {"stop_time": 20.0, "parameters": ("noisy.ssv",)}, []),
        ("robot_rendezvous", {"stop_time": 20.0}, []),
    ],
)
def test_a_flight_is_that_of_fmis_calls(monkeypatch, system, options, faults):
    ready = prepared(system, **options)
    with Simulation(ready, faults=faults) as simulation:
        simulation.set_faults(faults)
        assert in_memory(simulation) > 0
        by_memory = simulation.fly({})
        monkeypatch.setattr(Instance, "locate", lambda *_, **__: 0)
        with Simulation(ready, faults=faults) as plain:
            plain.set_faults(faults)
            assert in_memory(plain) == 0
            assert_same(by_memory, plain.fly({}))


def test_an_instance_that_takes_anothers_place_has_memory_of_its_own():
    with Simulation(prepared("lunar_terminal_guidance", stop_time=10.0)) as simulation:
        before = simulation.fly({})
        retained = {name: values.copy() for name, values in before.signals.items()}
        placed = simulation.program.instructions[:, codes.ADDRESS].copy()
        instance = simulation.instances["guidance"]
        spare = instance.slave.component  # so that the new one lies elsewhere
        instance.is_there = False
        simulation.life_cycle._running = set()
        after = simulation.fly({})
        moved = simulation.program.instructions[:, codes.ADDRESS] != placed
        assert np.isin(simulation.program.instructions[moved, codes.CODE], codes.IN_MEMORY).any()
        for name, values in retained.items():
            assert values.tobytes() == after.signals[name].tobytes(), name
        instance.slave.fmi2FreeInstance(spare)


def test_what_is_not_side_by_side_is_not_in_one_place():
    """Nor what is no Real, or cannot be set."""
    with Simulation(prepared("lunar_terminal_guidance")) as simulation:
        plant = simulation.instances["plant"]
        variables = plant.fmu.variables

        def locate(*names, **options):
            references = np.array([variables[name].reference for name in names], dtype=np.uint32)
            return plant.locate(references, **{"kind": "Real", **options})

        first = locate("position[1]")
        assert locate("position[1]", "position[2]", "position[3]") == first
        assert locate("position[2]") == first + 8
        assert locate("position[2]", "position[1]") == 0
        assert locate("position[1]", "position[3]") == 0
        assert locate("position[1]", to_set=True) == 0
        assert locate("position[1]", kind="Boolean") == 0
        assert locate("position[1]", kind="Integer") == 0


def test_an_integer_beyond_32_bits_fails_as_by_fmis_call(monkeypatch, tiny_folder):
    first = 2**31 - 4
    ready = prepare_system(
        tiny_folder / "native" / "ramp.fmu", SystemOptions(step=0.5, stop_time=5.0, set={"ramp.first_count": first})
    )
    with Simulation(ready) as simulation:
        assert in_memory(simulation) > 0
        by_memory = simulation.fly({})
        assert by_memory.signals["ramp.count"].tolist() == [first, first + 1, first + 2, 2**31 - 1]
        assert (by_memory.status, by_memory.time[-1]) == ("failed", 1.5)
        assert f"count = {2**31} exceeds an FMI Integer's 32 bits" in by_memory.message
        monkeypatch.setattr(Instance, "locate", lambda *_, **__: 0)
        with Simulation(ready) as plain:
            actual = plain.fly({})
            assert actual.message == by_memory.message
            assert_same(by_memory, actual)
