"""Landing sequencer stepped with inputs of a test: on the orbit, braking, hovering."""

import math

import numpy as np

from perilune.fmus_src.sequencing.landing_sequencer import LandingSequencer

H = 0.1
RADIUS = 1.7374e6
MU = 4.9028e12
ORBIT = RADIUS + 1e5
CENTRE = np.array([0.0, 0.0, -RADIUS])
SPEED = math.sqrt(MU / ORBIT)
OWN, BRAKING, HOVER = 1, 2, 3
IDLE, HOLD, PROGRAMME, SLOW, CAPTURE, SINK = range(6)


def at(angle, altitude=1e5, speed=SPEED):
    """Estimate at a central angle on the way to smaller ones."""
    place = (RADIUS + altitude) * np.array([math.sin(angle), 0.0, math.cos(angle)]) + CENTRE
    return {
        "estimated_position": place.tolist(),
        "estimated_velocity": [-speed * math.cos(angle), 0.0, speed * math.sin(angle)],
    }


class Flown:
    """A sequencer in flight."""

    def __init__(self, start_phase, **values):
        self.block = LandingSequencer(start_phase=start_phase, mass=values.pop("mass", 600.0))
        self.see(**values)
        self.time = 0.0
        self.answers = True
        self.block.initialize()

    def see(self, **values):
        for name, value in values.items():
            setattr(self.block, name, value)

    def step(self, count=1, **values):
        """Step ``count`` times with these inputs, answered by the guidances at once unless they say otherwise."""
        self.answers = values.pop("answers", self.answers)
        self.see(**values)
        for _ in range(count):
            if self.answers:
                self.see(hover_plan=self.block.plan_number, braking_command_time=self.time)
            self.block.step(self.time, H)
            self.time = round(self.time + H, 9)
        return self.block

    def until(self, phase, most, **values):
        """Step until the phase has come; the time of it."""
        self.see(**values)
        for _ in range(round(most / H) + 1):
            if self.block.phase == phase:
                return self.block.phase_time[phase - 1]
            self.step()
        raise AssertionError(f"phase {phase} has not come, but {self.block.phase}")


def hovering(phase, **values):
    """Return a flight in a hover phase, at its target and at rest."""
    flown = Flown(phase, **values)
    flown.see(estimated_position=flown.block.target_position)
    return flown


def braking(**values):
    flown = Flown(3, **at(0.16, altitude=15e3))
    flown.see(attitude=[1.0, 0.0, 0.0], braking_direction=[1.0, 0.0, 0.0], braking_time_to_go=340.0)
    flown.see(**values)
    return flown
