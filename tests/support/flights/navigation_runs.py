"""Navigation blocks run through the measurements of a complete flight, as Python objects and as native FMUs."""

import ctypes

import numpy as np

from tests.support.flights.braking_flight import STEP, STEPS, position, velocity
from tests.support.kernels.native_instance import OK, NativeInstance

MEASURED = ("velocity_increment", "measured_altitude", "measured_velocity", "measured_position")
COUNTS = ("inertial_count", "altitude_count", "velocity_count", "position_count")
NO_FIRST_ERRORS = {"first_position_sigma": 0.0, "first_velocity_sigma": 0.0}


def counts(measurements):
    """Return the four counts at every communication point; none of an inertial sample at the start."""
    new = (measurements.new_altitude, measurements.new_velocity, measurements.new_position)
    return np.column_stack([np.arange(STEPS + 1), *(np.cumsum(each) for each in new)])


def truth(k):
    """Return position and velocity at communication points."""
    return np.hstack([position(np.asarray(k) * STEP), velocity(np.asarray(k) * STEP)])


def plain(block_class, measurements, **settings):
    """Yield (k, block) after initialisation (k = 0) and after every step k."""
    block = block_class(position=position(0.0).tolist(), velocity=velocity(0.0).tolist(), **settings)
    counted = counts(measurements).tolist()
    for k in range(STEPS + 1):
        block.velocity_increment = measurements.increment[k].tolist()
        block.measured_altitude = float(measurements.altitude[k])
        block.measured_velocity = measurements.velocity[k].tolist()
        block.measured_position = measurements.position[k].tolist()
        for name, value in zip(COUNTS, counted[k], strict=True):
            setattr(block, name, value)
        if k == 0:
            block.initialize()
        else:
            block.step((k - 1) * STEP, STEP)
        yield k, block


def state_of(block):
    """Return estimated position and velocity."""
    return np.array([*block.estimated_position, *block.estimated_velocity])


class Native:
    """A block's native FMU, to be flown many times."""

    def __init__(self, block_class):
        self.instance = NativeInstance(block_class)
        names = {
            name: (variable, n)
            for variable in block_class.variables.values()
            for n, name in enumerate(variable.element_names())
        }
        self.numbers = {}
        for number, (variable, _) in enumerate(names.values()):
            self.numbers.setdefault(variable.name, []).append(number)

    def references(self, names):
        return [number for name in names for number in self.numbers[name]]

    def fly(self, measurements, at, outputs, **settings):
        """Return rows of the Real outputs at the communication points ``at``, by name of the output."""
        instance = self.instance
        instance.reset()
        assert instance.set(self.references(settings), list(settings.values())) == OK
        assert instance.set(self.references(["position", "velocity"]), [*position(0.0), *velocity(0.0)]) == OK
        reals = np.ascontiguousarray(
            np.column_stack(
                [measurements.increment, measurements.altitude, measurements.velocity, measurements.position]
            )
        )
        integers = np.ascontiguousarray(counts(measurements).astype(np.int32))
        measured, counted, read = (
            (ctypes.c_uint * len(collected))(*collected)
            for collected in map(self.references, (MEASURED, COUNTS, outputs))
        )
        buffer = (ctypes.c_double * len(read))()
        rows = []
        for k in range(STEPS + 1):
            assert instance.call("fmi2SetReal", measured, 10, ctypes.c_void_p(reals[k].ctypes.data)) == OK
            assert instance.call("fmi2SetInteger", counted, 4, ctypes.c_void_p(integers[k].ctypes.data)) == OK
            if k == 0:
                instance.enter()
                assert instance.start() == OK, instance.log
            else:
                assert instance.do_step((k - 1) * STEP, STEP) == OK, instance.log
            if k in at:
                assert instance.call("fmi2GetReal", read, len(read), buffer) == OK
                rows.append(np.array(buffer))
        ends = np.cumsum([len(self.numbers[name]) for name in outputs])[:-1]
        return dict(zip(outputs, np.split(np.array(rows), ends, axis=1), strict=True))
