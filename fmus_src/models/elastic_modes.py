"""Modes of a spacecraft's appendages and sloshing propellant."""

import math

from ..block import Block, Output, Parameter, State
from ..kernel.matrices import (
    Matrix,
    diagonal,
    identity,
    inverse,
    is_positive_definite,
    largest_eigenvalue,
    zeros,
)
from ..mathlib.vectors import Vector3, Vector4

MODES = 4


class ElasticModes(Block, interface=True):
    """Up to four elastic or slosh modes in hybrid coordinates, each with a displacement η and a momentum p.

    On a fixed base a mode is a linear oscillator of frequency W and damping ratio ζ; the motion of the base drives it.
    With participation L in translation and D in rotation about the undeformed centre of mass, spacecraft mass M and
    force F:

        M_e = 1 - L^T L/M    η' = M_e^-1 (p - D^T ω)    p' = -L^T F/M - 2 ζ W η' - W^2 η

    A slosh particle of mass m at s moving along e has

        L = sqrt(m) e    D = sqrt(m) s × e

    and a hinged panel with inertia I_h about its hinge axis a, own inertia I_s about its centre of mass s, and velocity
    d of s per hinge rate has

        L = m d/sqrt(I_h)    D = (I_s a + m s × d)/sqrt(I_h)

    Assumes angular rates far below the modes' frequencies, and small displacements.

    Source: Likins 1970, with momenta in place of velocities; Dodge 2000; Allard, Schaub and Piggott 2018.
    """

    mode_frequency = Parameter(
        [0.0] * MODES,
        unit="rad/s",
        minimum=0.0,
        description="natural frequencies of the modes with the body fixed; 0: no mode",
    )
    mode_damping = Parameter(
        [0.005] * MODES, unit="1", minimum=0.0, description="damping ratios of the modes with the body fixed"
    )
    mode_translation = Parameter(
        [0.0] * (3 * MODES),
        frame="body",
        columns=3,
        description="participation of each mode in translation, one mode per row, square root of kg",
    )
    mode_rotation = Parameter(
        [0.0] * (3 * MODES),
        frame="body",
        columns=3,
        description="participation of each mode in rotation, one mode per row, m times square root of kg",
    )
    mode_displacements = Output([0.0] * MODES, description="modal displacements, m times square root of kg")
    modal_momenta = State([0.0] * MODES, description="modal momenta, m/s times square root of kg")
    translation = State(
        zeros(3, MODES),
        description="participation matrix L of the modes in translation, one mode per column (body frame)",
    )
    rotation = State(
        zeros(3, MODES), description="participation matrix D of the modes in rotation, one mode per column (body frame)"
    )
    inverse_modal_mass = State(zeros(MODES, MODES), description="inverse of the modal mass matrix")
    modal_coupling = State(
        zeros(3, MODES), description="coupling matrix of the modes with the rotation of the body (body frame)"
    )

    def start_modes(self, mass: float) -> bool:
        """Set the constant matrices for a total mass (kg); return False if the modes contain more than this mass."""
        self.translation = zeros(3, MODES)
        self.rotation = zeros(3, MODES)
        for k in range(MODES):
            if self.mode_frequency[k] > 0.0:
                self.translation[0:3, k] = self.mode_translation[k, 0:3]
                self.rotation[0:3, k] = self.mode_rotation[k, 0:3]
        modal_mass = identity(MODES) - self.translation.T @ self.translation / mass
        self.inverse_modal_mass, invertible = inverse(modal_mass)
        self.modal_coupling = self.rotation @ self.inverse_modal_mass
        return invertible and is_positive_definite(modal_mass)

    def modal_inertia(self) -> Matrix:
        """Return the contribution D (1 - L'L/M)^-1 D' of the modes to the inertia matrix (kg m2)."""
        return self.modal_coupling @ self.rotation.T

    def largest_frequency(self, mass: float, inverse_inertia: Matrix) -> float:
        """Return the highest natural frequency (rad/s) of the free body, from mass (kg) and inverse inertia (1/(kg
        m2)).

        Its square is the largest eigenvalue of W (1 - L'L/M - D'I^-1 D)^-1 W; infinite if that matrix is not positive.
        """
        shared = self.translation.T @ self.translation / mass + self.rotation.T @ inverse_inertia @ self.rotation
        free = identity(MODES) - shared
        if not is_positive_definite(free):
            return math.inf
        inverse_free, _ = inverse(free)
        frequencies = diagonal(self.mode_frequency)
        return math.sqrt(largest_eigenvalue(frequencies @ inverse_free @ frequencies))

    def displaced_centre(self, displacements: Vector4, mass: float) -> Vector3:
        """Return the displacement (m, body) of the centre of mass due to the deformation."""
        return self.translation @ displacements / mass

    def modal_velocities(self, momenta: Vector4, w: Vector3) -> Vector4:
        """Return the time derivatives of the modal displacements for an angular velocity w (rad/s, body)."""
        return self.inverse_modal_mass @ (momenta - self.rotation.T @ w)

    def modal_forces(self, displacements: Vector4, velocities: Vector4, acceleration: Vector3) -> Vector4:
        """Return the time derivatives of the modal momenta, for an acceleration (m/s2, body) by external forces."""
        damping = self.mode_damping * self.mode_frequency * velocities
        stiffness = self.mode_frequency * self.mode_frequency * displacements
        return -(self.translation.T @ acceleration) - 2.0 * damping - stiffness
