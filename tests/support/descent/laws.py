"""Shared code of tests of the descent laws: classes, states, and descents over a spherical Moon."""

import numpy as np

from perilune.fmus_src.guidance.apollo import ApolloGuidance
from perilune.fmus_src.guidance.fractional import FractionalGuidance
from perilune.fmus_src.guidance.gravity_turn import GravityTurnGuidance
from perilune.fmus_src.guidance.powered import PoweredGuidance
from perilune.fmus_src.guidance.zem_zev import ZemZevGuidance
from perilune.fmus_src.plants.spherical_moon_lander import SphericalMoonLander
from tests.support.descent.polynomial_laws import Leg

POLYNOMIAL = [ZemZevGuidance, FractionalGuidance, ApolloGuidance]
TO_A_PLACE = [*POLYNOMIAL, PoweredGuidance]
DESCENT_LAWS = [*TO_A_PLACE, GravityTurnGuidance]
SITE = {"gravity": 1.624219, "gravity_correction": True}
HIGH, LOW = np.array([0.0, 0.0, 1500.0]), np.array([0.0, 0.0, 100.0])
C1 = Leg(
    np.array([100548.8128555642, 0.0, 7605.543324529426]), np.array([-949.9869131254377, 0.0, 4.98647073610168]), HIGH
)
C2 = Leg(
    np.array([266731.0182801091, 0.0, -2233.3382089037914]),
    np.array([-1676.17261973568, 0.0, 207.76512904822894]),
    HIGH,
)
A1 = Leg(np.array([1200.0, -900.0, 1900.0]), np.array([-45.0, 30.0, -30.0]), LOW)
MASSES = {id(C1): 940.0, id(C2): 940.0, id(A1): 560.0}


def start(guidance_class, leg, **parameters):
    """Return a guidance at the start of a leg, after its first command."""
    guidance = guidance_class(
        position=leg.position.tolist(),
        velocity=leg.velocity.tolist(),
        mass=parameters.pop("mass", MASSES.get(id(leg), 940.0)),
        target_position=leg.target.tolist(),
        **{**SITE, **parameters},
    )
    guidance.initialize()
    return guidance


def fly(guidance, leg, step=0.5, loss=0.0, limit=2000, aside=None):
    """Fly plant and guidance in turn to the end; return the plant, and rows of thrust (N) and time_to_go.

    ``loss`` is the fraction of thrust that the engine lacks, ``aside`` a row and the place that is the target from
    there on.
    """
    plant = SphericalMoonLander(
        initial_position=leg.position.tolist(),
        initial_velocity=leg.velocity.tolist(),
        initial_mass=guidance.mass,
        latch_at_burn_end=True,
    )
    plant.initialize()
    rows = []
    for k in range(limit):
        if guidance.finished:
            break
        demand = min(guidance.thrust_acceleration * plant.mass, 5099.0)
        rows.append([demand, guidance.time_to_go, guidance.limit])
        plant.thrust = (1.0 - loss) * demand
        plant.thrust_direction, plant.thrust_direction_rate = guidance.thrust_direction, guidance.thrust_direction_rate
        plant.command_time, plant.burn_duration = guidance.command_time, guidance.burn_duration
        plant.step(k * step, step)
        if aside is not None and k == aside[0]:
            guidance.divert_count, guidance.divert_position = guidance.divert_count + 1, list(aside[1])
        guidance.position, guidance.velocity, guidance.mass = plant.position, plant.velocity, plant.mass
        guidance.step(k * step, step)
    return plant, np.array(rows)
