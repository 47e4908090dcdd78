"""Run of an observer of the orbital attitude, sample by sample."""

from importlib import import_module

from perilune.fmus_src.runtime import BlockInstance

TICK = 0.2
OBSERVERS = [
    "orbital_observer_continuous",
    "orbital_observer_continuous_split",
    "orbital_observer_continuous_reduced",
    "orbital_observer_discrete",
    "orbital_observer_discrete_split",
    "orbital_observer_discrete_reduced",
    "orbital_observer_discrete_reduced_split",
    "orbital_filter",
    "orbital_sequence",
    "orbital_true_state",
]


def block_class(name, kind="navigation"):
    """Return the class of a block by its FMU's name."""
    module = import_module(f"perilune.fmus_src.{kind}.{name}")
    return getattr(module, "".join(token.capitalize() for token in name.split("_")))


SPLIT = "_split"  # of an observer's name: with split, it follows each pulse


class Run:
    """One observer, with (roll, pitch, rates) as inputs at each tick and the pulses before it."""

    def __init__(self, name, sample, pulses=(0.0, 0.0, 0.0), **parameters):
        self.component = BlockInstance(block_class(name.removesuffix(SPLIT)))
        self.block = self.component.block
        self.tick = 0
        if name.endswith(SPLIT):
            parameters["split"] = True
        for parameter, value in parameters.items():
            setattr(self.block, parameter, value)
        self.give(sample, pulses, True)
        self.component.start()

    def give(self, sample, pulses, new):
        roll, pitch, rates = sample
        self.block.measured_roll, self.block.measured_pitch = roll, pitch
        self.block.measured_angular_velocity, self.block.fired_pulses = rates, pulses
        if new:
            self.block.vertical_count = self.block.gyro_count = self.block.gyro_count + 1

    def step(self, sample, pulses=(0.0, 0.0, 0.0), new=True):
        """Advance a tick; return the estimated angles and rates."""
        period = self.block.sample_period
        self.give(sample, pulses, new)
        self.component.do_step(self.tick * period, period)
        self.tick += 1
        return [*self.block.estimated_angles, *self.block.estimated_angular_velocity]
