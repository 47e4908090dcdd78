"""kalman_navigation compared with filterpy over complete flights, and as an FMU.

Truth: `filterpy.kalman.KalmanFilter` with all matrices written out; 1e-9 m and 1e-9 m/s in every estimate and standard
deviation. The Python FMU equals the plain object, to the bit, and its state can be restored.
"""

import math

import numpy as np
import pytest

from perilune.analysis.runtime.instances.instance import instantiate
from perilune.analysis.runtime.system.fmu import load_fmu
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
from perilune.fmus_src.navigation.kalman import KalmanNavigation
from perilune.fmus_src.navigation.kalman_filterpy import KalmanNavigationFilterpy
from perilune.fmus_src.runtime import BlockInstance
from tests.support.flights.braking_flight import STEP, measurements
from tests.support.flights.navigation_runs import plain, state_of
from tests.support.lengths import either

COMPARED = (
    "estimated_position",
    "estimated_velocity",
    "estimated_bias",
    "position_estimate_sigma",
    "velocity_estimate_sigma",
    "estimate_covariance",
)


def with_trouble(measured, trouble):
    """Return measurements with an outlier, a sample that is NaN, or a sensor that stays wrong."""
    fixes = np.flatnonzero(measured.new_position)
    if trouble == "outlier":
        measured.position[fixes[10], 1] += 2e3
        measured.altitude[np.flatnonzero(measured.new_altitude)[50]] = math.nan
    elif trouble == "shift":
        measured.position[fixes[30:], 0] += 1e3
    return measured


@pytest.mark.parametrize(("seed", "trouble"), either([(1, "none"), (2, "outlier"), (3, "shift")], [(2, "outlier")]))
def test_agrees_over_a_whole_flight(seed, trouble):
    measured = with_trouble(measurements(seed), trouble)
    settings = {"seed": 4, "stream": seed, "reacquire": trouble == "shift"}
    flights = [plain(block_class, measured, **settings) for block_class in (KalmanNavigation, KalmanNavigationFilterpy)]
    for (_, mine), (k, other) in zip(*flights, strict=True):
        values, expected = (np.array([x for name in COMPARED for x in getattr(each, name)]) for each in (mine, other))
        assert np.all(abs(values - expected) <= 1e-9 * np.maximum(abs(expected), 1.0)), k
        counts = [[block.rejected_count, block.sample_count, block.status] for block in (mine, other)]
        assert counts[0] == counts[1]
    assert other.innovation_square == pytest.approx(mine.innovation_square, rel=1e-9)
    assert (other.rejected_count > 0) == (trouble != "none")


def test_it_has_the_same_connectors():
    assert list(KalmanNavigationFilterpy.variables) == list(KalmanNavigation.variables)


class Driven:
    """A Component or an FMU's slave, by names of variables."""

    def __init__(self, block_class, slave=None):
        self.component = BlockInstance(block_class)
        self.slave = slave
        self.kinds = {}
        for variable in block_class.variables.values():
            for name in variable.element_names():
                self.kinds[name] = (len(self.kinds), variable.type_name)
        self.outputs = [name for name, (_, kind) in self.kinds.items() if kind == "Real"]

    def set(self, values):
        for name, value in values.items():
            reference, kind = self.kinds[name]
            if self.slave is None:
                self.component.set([reference], [value])
            else:
                getattr(self.slave, f"set{kind}")([reference], [value])

    def get(self):
        references = [self.kinds[name][0] for name in self.outputs]
        return self.component.get(references) if self.slave is None else list(self.slave.getReal(references))

    def begin(self):
        self.set({"position[1]": 2.6e5, "velocity[1]": -1.6e3, "stream": 3})
        if self.slave is None:
            self.component.start()
        else:
            self.slave.setupExperiment(startTime=0.0)
            self.slave.enterInitializationMode()
            self.slave.exitInitializationMode()

    def fly(self, first, last):
        rows = []
        for k in range(first, last):
            self.set({"velocity_increment[1]": 0.4, "velocity_increment[3]": 0.1, "inertial_count": k})
            self.set(
                {"measured_altitude": 1.8e4 + k, "altitude_count": k // 5, "measured_position[1]": 2.6e5 - 160.0 * k}
            )
            self.set({"position_count": k // 8})
            if self.slave is None:
                self.component.do_step((k - 1) * STEP, STEP)
            else:
                self.slave.doStep((k - 1) * STEP, STEP)
            rows.append(self.get())
        return rows


def test_the_fmu_steps_as_the_plain_object_and_its_state_can_be_put_back(tmp_path):
    path = build_python_fmu(KalmanNavigationFilterpy, tmp_path / "filter.fmu")
    instance = instantiate(load_fmu(path.read_bytes(), str(path)), "filter")
    fmu = Driven(KalmanNavigationFilterpy, instance.slave)
    object_ = Driven(KalmanNavigationFilterpy)
    for each in (fmu, object_):
        each.begin()
    assert fmu.fly(1, 30) == object_.fly(1, 30)
    state = fmu.slave.getFMUState()
    retained = object_.component.get_state()
    ahead = fmu.fly(30, 60)
    fmu.slave.setFMUState(state)
    object_.component.set_state(retained)
    assert fmu.fly(30, 60) == ahead == object_.fly(30, 60)
    instance.free()


def test_declared_starts_alone_run():
    block = KalmanNavigationFilterpy()
    block.initialize()
    block.step(0.0, 0.1)
    assert block.status == 0
    assert np.isfinite(state_of(block)).all()
