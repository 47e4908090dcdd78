"""The flight in Basilisk."""

import numpy as np
from Basilisk.simulation import linearSpringMassDamper

from crosscheck.basilisk_side import column
from crosscheck.space.basilisk_swing import swing
from crosscheck.space.hub import hub_of
from crosscheck.swings.slosh.case import (
    ALONG,
    CASE,
    DAMPING,
    FORCE,
    FREQUENCY,
    INERTIA,
    MASS,
    PARTICLES,
    POSITIONS,
    TORQUE,
)
from crosscheck.table import Table


def fly(amplitude: float) -> Table:
    """Swing with spring W^2 m, damper 2 zeta W m."""
    particles = []
    for mass, position, along, frequency, damping in zip(PARTICLES, POSITIONS, ALONG, FREQUENCY, DAMPING, strict=True):
        particle = linearSpringMassDamper.LinearSpringMassDamper()
        particle.massInit, particle.r_PB_B, particle.pHat_B = float(mass), column(position), column(along)
        particle.k, particle.c = float(mass * frequency**2), float(2.0 * damping * frequency * mass)
        particle.rhoInit, particle.rhoDotInit = 0.0, 0.0
        particles.append(particle)
    masses = [(float(mass), position, np.zeros((3, 3))) for mass, position in zip(PARTICLES, POSITIONS, strict=True)]
    names = [particle.nameOfRhoState for particle in particles]
    drive = (amplitude * FORCE, amplitude * TORQUE)
    return swing(hub_of(MASS, INERTIA, masses), particles, names, drive, CASE.step, CASE.duration)
