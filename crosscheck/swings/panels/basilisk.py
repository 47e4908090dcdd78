"""The flight in Basilisk."""

import numpy as np
from Basilisk.simulation import hingedRigidBodyStateEffector

from crosscheck.basilisk_side import column
from crosscheck.space.basilisk_swing import swing
from crosscheck.space.hub import hub_of
from crosscheck.swings.panels.case import (
    ABOUT_HINGE,
    ARM,
    AXIS,
    CASE,
    CENTRES,
    DAMPING,
    FORCE,
    FREQUENCY,
    HINGES,
    INERTIA,
    MASS,
    OUTWARDS,
    PANEL,
    PANEL_INERTIA,
    TORQUE,
)
from crosscheck.table import Table


def fly(amplitude: float) -> Table:
    """Swing with spring W^2 Ih, damper 2 zeta W Ih; first axis of a hinge inwards, second the hinge's."""
    panels = []
    for hinge, outwards, frequency, damping in zip(HINGES, OUTWARDS, FREQUENCY, DAMPING, strict=True):
        axes = np.array([-outwards, AXIS, np.cross(-outwards, AXIS)])
        panel = hingedRigidBodyStateEffector.HingedRigidBodyStateEffector()
        panel.mass, panel.d, panel.r_HB_B, panel.dcm_HB = PANEL, ARM, column(hinge), axes.tolist()
        panel.IPntS_S = (axes @ PANEL_INERTIA @ axes.T).tolist()
        panel.k, panel.c = float(ABOUT_HINGE * frequency**2), float(2.0 * damping * frequency * ABOUT_HINGE)
        panel.thetaInit, panel.thetaDotInit = 0.0, 0.0
        panels.append(panel)
    masses = [(PANEL, centre, PANEL_INERTIA) for centre in CENTRES]
    names = [panel.nameOfThetaState for panel in panels]
    drive = (amplitude * FORCE, amplitude * TORQUE)
    return swing(hub_of(MASS, INERTIA, masses), panels, names, drive, CASE.step, CASE.duration)
