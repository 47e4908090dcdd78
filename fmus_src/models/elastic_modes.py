"""Modes of appendages and of sloshing propellant on a spacecraft."""

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
    """Up to four modes in hybrid coordinates: displacement and momentum of each, and how they take part in the motion.

    A mode is a linear oscillator that the acceleration of its base drives: mode_translation and mode_rotation are its
    participation about the undeformed centre of mass of the whole. A particle (slosh) of mass m at s that moves along p
    has sqrt(m) p and sqrt(m) s x p. A hinged panel of mass m has m d/sqrt(Ih) and (Is a + m s x d)/sqrt(Ih), with its
    inertia Ih about the hinge axis a, its matrix of inertia Is about its own centre of mass at s, and d the velocity of
    that by the hinge rate. Linear: rates far below the mode's frequency and small displacements.
    Source: Likins 1970, with momenta in place of velocities; Dodge 2000; Allard, Schaub and Piggott 2018.
    """

    mode_frequency = Parameter([0.0] * MODES, unit="rad/s", minimum=0.0, description="on a fixed base; 0: no mode")
    mode_damping = Parameter([0.005] * MODES, unit="1", minimum=0.0, description="ratio of damping on a fixed base")
    mode_translation = Parameter(
        [0.0] * (3 * MODES), frame="body", columns=3, description="participation in translation by mode, root of kg"
    )
    mode_rotation = Parameter(
        [0.0] * (3 * MODES),
        frame="body",
        columns=3,
        description="participation in rotation by mode, root of kg times m",
    )
    mode_displacements = Output([0.0] * MODES, description="modal displacements, m times the root of kg")
    modal_momenta = State([0.0] * MODES, description="modal momenta, m/s times the root of kg")
    translation = State(zeros(3, MODES), description="L, participation in translation by column")
    rotation = State(zeros(3, MODES), description="D, participation in rotation by column")
    inverse_modal_mass = State(zeros(MODES, MODES), description="(1 - L'L/M)^-1")
    modal_coupling = State(zeros(3, MODES), description="D (1 - L'L/M)^-1")

    def start_modes(self, mass: float) -> bool:
        """Set the constant matrices for a mass (kg) of the whole; False where the modes hold more than that."""
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
        """Return what the modes take of the matrix of inertia (kg m2): D (1 - L'L/M)^-1 D'."""
        return self.modal_coupling @ self.rotation.T

    def largest_frequency(self, mass: float, inverse_inertia: Matrix) -> float:
        """Return the largest frequency (rad/s) of the free whole, by its mass (kg) and inverse inertia, 1/(kg m2).

        Its square is the largest eigenvalue of W (1 - L'L/M - D'I^-1 D)^-1 W; infinite where that is not positive.
        """
        shared = self.translation.T @ self.translation / mass + self.rotation.T @ inverse_inertia @ self.rotation
        free = identity(MODES) - shared
        if not is_positive_definite(free):
            return math.inf
        inverse_free, _ = inverse(free)
        frequencies = diagonal(self.mode_frequency)
        return math.sqrt(largest_eigenvalue(frequencies @ inverse_free @ frequencies))

    def displaced_centre(self, displacements: Vector4, mass: float) -> Vector3:
        """Return how far (m, body) the centre of mass is from where it is without deformation."""
        return self.translation @ displacements / mass

    def modal_velocities(self, momenta: Vector4, w: Vector3) -> Vector4:
        """Return the rates of the displacements on a body with the angular velocity w (rad/s)."""
        return self.inverse_modal_mass @ (momenta - self.rotation.T @ w)

    def modal_forces(self, displacements: Vector4, velocities: Vector4, acceleration: Vector3) -> Vector4:
        """Return the rates of the momenta, with the acceleration (m/s2, body) that forces give to the whole."""
        damping = self.mode_damping * self.mode_frequency * velocities
        stiffness = self.mode_frequency * self.mode_frequency * displacements
        return -(self.translation.T @ acceleration) - 2.0 * damping - stiffness
