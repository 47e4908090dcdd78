"""Complete memory of a system: saved, restored, read and changed, in both flavours of Perilune's FMUs.

Truth: undisturbed simulations; equations of motion; the same system in the other flavour.
"""

import re

import numpy as np
import pytest

from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.builders import pack, retouched
from tests.support.loops.exact_systems import ring

STEP, SAVED, LAST = 0.25, 20, 40
PARTS = {
    "noise": ("noisy_counter", "u", "y", "sigma=Real:0.3"),
    "control": ("difference", "u", "y", "sample_period=Real:0.75"),
    "late": ("late", "u", "y", "samples=Integer:3"),
    "plant": ("held_mass", "u", "position", "speed=Real:0.125"),
}


def prepared(folder, fmus):
    path = pack(folder / "s.ssp", fmus, ring(PARTS, STEP, 20.0))
    return prepare_system(path, SystemOptions())


@pytest.fixture(params=["native", "python"])
def simulation(request, exact_folder, tmp_path):
    with Simulation(prepared(tmp_path, exact_folder / request.param)) as actual:
        yield actual


def fly(simulation, first, last):
    flight = simulation.advance(first, last)
    assert flight.status == "stop_time"
    return {name: values.copy() for name, values in flight.signals.items()}


def saved(simulation):
    """Return the memory at SAVED, and its saved state."""
    memory = simulation.memory()
    fly(simulation, -1, SAVED)
    return memory, memory.save(SAVED)


def assert_same(one, other):
    assert one.keys() == other.keys()
    for name, values in one.items():
        assert values.tobytes() == other[name].tobytes(), name


def whole_numbers(simulation):
    """Return all numbers that are no Reals: count, even."""
    actual = []
    for instance in simulation.instances.values():
        for variable in instance.fmu.variables.values():
            if variable.type == "Integer":
                actual += instance.slave.getInteger([variable.reference])
            if variable.type == "Boolean":
                actual += instance.slave.getBoolean([variable.reference])
    return actual


def test_put_back_it_flies_on_as_it_did(simulation):
    """Noise, counters and control's ticks included, and however far it has flown meanwhile."""
    whole = fly(simulation, -1, LAST)
    memory, snapshot = saved(simulation)
    before = memory.read().copy()
    first = fly(simulation, SAVED, LAST)
    end = memory.read().copy()
    assert_same({name: values[SAVED + 1 :] for name, values in whole.items()}, first)
    fly(simulation, -1, 7)
    memory.restore(snapshot)
    assert memory.read().tobytes() == before.tobytes()
    assert_same(first, fly(simulation, SAVED, LAST))
    assert memory.read().tobytes() == end.tobytes()
    memory.release(snapshot)


def test_cells_are_all_real_numbers_but_parameters_and_random_generators(simulation):
    memory = simulation.memory()
    names = [cell.name for cell in memory.cells]
    assert len(set(names)) == len(names)
    of_noise = [name for name in names if name.startswith("noise.") and "exchanged" not in name]
    assert sorted(of_noise) == ["noise.mean[1]", "noise.mean[2]", "noise.u", "noise.y"]
    assert {f"late.line[{index}]" for index in range(1, 33)} < set(names)
    assert {"plant.position", "plant.velocity", "plant.u", "control.last", "control.y"} < set(names)
    assert not any("sigma" in name or "sample_period" in name or "samples" in name for name in names)
    assert {name for name in names if "exchanged" in name} == {"noise.y as exchanged", "control.y as exchanged"}
    units = {cell.name: cell.unit for cell in memory.cells}
    assert (units["plant.velocity"], units["noise.mean[2]"], units["late.y"]) == ("m/s", "m", None)


def test_one_cell_is_changed_and_nothing_else(simulation):
    memory, snapshot = saved(simulation)
    before, whole = memory.read().copy(), whole_numbers(simulation)
    assert len(whole) > 2
    for place, cell in enumerate(memory.cells):
        value = before[place] + 0.1 + 1e-9 * place
        memory.restore(snapshot, cell, value)
        after = memory.read().copy()
        assert after[place] == value, cell.name
        after[place] = before[place]
        assert after.tobytes() == before.tobytes(), cell.name
        assert whole_numbers(simulation) == whole
    memory.restore(snapshot)
    unchanged = fly(simulation, SAVED, LAST)
    fly(simulation, -1, SAVED)
    assert_same(unchanged, fly(simulation, SAVED, LAST))


def test_a_changed_cell_acts_as_the_equations_say(simulation):
    """Velocity moves the position by a step of it; the delay's line comes out in its order."""
    memory, snapshot = saved(simulation)
    places = {cell.name: index for index, cell in enumerate(memory.cells)}
    before, expected = memory.read().copy(), {}
    memory.restore(snapshot)
    base = fly(simulation, SAVED, SAVED + 3)
    for name, change in (("plant.velocity", 0.5), ("late.line[1]", 2.0), ("late.line[2]", 2.0)):
        memory.restore(snapshot, memory.cells[places[name]], before[places[name]] + change)
        flown = fly(simulation, SAVED, SAVED + 3)
        expected[name] = flown["plant.position"] - base["plant.position"]
    assert expected["plant.velocity"][:2] == pytest.approx([0.5 * STEP, STEP], abs=1e-12)
    assert expected["late.line[1]"][:2] == pytest.approx([0.0, STEP**2], abs=1e-12)
    assert expected["late.line[2]"][:2] == pytest.approx([0.0, 0.0], abs=1e-12)
    assert expected["late.line[2]"][2] == pytest.approx(STEP**2, abs=1e-12)


def test_both_flavours_remember_the_same(exact_folder, tmp_path):
    actual = []
    for flavour in ("native", "python"):
        (tmp_path / flavour).mkdir()
        with Simulation(prepared(tmp_path / flavour, exact_folder / flavour)) as simulation:
            memory, snapshot = saved(simulation)
            cells = [(cell.name, cell.unit) for cell in memory.cells]
            at_saved = memory.read().copy()
            place = [name for name, _ in cells].index("noise.mean[1]")
            memory.restore(snapshot, memory.cells[place], -0.1)
            signals = fly(simulation, SAVED, LAST)
            actual.append((cells, at_saved.tobytes(), signals, memory.read().tobytes()))
    native, python = actual
    assert native[0] == python[0]
    assert native[1] == python[1]
    assert_same(native[2], python[2])
    assert native[3] == python[3]


@pytest.mark.parametrize(
    "change",
    [
        lambda text: re.sub(r"<VendorAnnotations>.*</VendorAnnotations>", "", text, flags=re.DOTALL),
        lambda text: re.sub(r'(<SerializedState[^>]*?)encoding="\w+"', r'\1encoding="others"', text),
    ],
    ids=["no annotation", "unknown encoding"],
)
def test_an_fmu_that_does_not_tell_is_refused_by_name(exact_fmus, tmp_path, change):
    silent = retouched(exact_fmus / "held_mass.fmu", tmp_path / "silent.fmu", change)
    path = pack(tmp_path / "s.ssp", exact_fmus, ring(PARTS, STEP, 20.0))
    options = SystemOptions(use={"plant": str(silent)})
    with (
        Simulation(prepare_system(path, options)) as simulation,
        pytest.raises(InputError, match=r"silent\.fmu.*plant.*does not document how it serialises its state") as caught,
    ):
        simulation.memory()
    assert "\n" not in str(caught.value)


def test_signals_and_memory_agree(simulation):
    memory, _ = saved(simulation)
    values = dict(zip((cell.name for cell in memory.cells), memory.read(), strict=True))
    flight = fly(simulation, -1, SAVED)
    for name in ("noise.y", "control.y", "late.y", "plant.position", "plant.velocity"):
        assert values[name] == flight[name][-1]
    assert values["control.y as exchanged"] == flight["control.y"][-1]
    assert np.isfinite(list(values.values())).all()
