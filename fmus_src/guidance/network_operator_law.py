"""Descent law by a network operator: parameters and evaluation."""

import math

from ..block import Block, Parameter, State
from ..mathlib.lunar.gravity import STANDARD_GRAVITY
from ..mathlib.network_operator import LARGEST, LOG_LARGEST, MAXIMUM_EDGES, SIZE, SOURCES, decode, evaluate, neutral
from ..mathlib.vectors import clip

KILOGRAM_FORCE = STANDARD_GRAVITY  # N

# The law found by Diveev, Pupkov and Sofronova (2013).
PUBLISHED_MATRIX = (
    *(0, 0, 0, 0, 0, 0, 1, 23, 0, 0, 0, 0, 0, 0, 0, 0),
    *(0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0),
    *(0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 9, 0, 0, 4, 0, 0),
    *(0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 5, 0, 0, 0),
    *(0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 11, 0, 0, 0, 0),
    *(0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0),
    *(0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 18, 0, 0, 0),
    *(0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 9, 0),
    *(0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 0, 0),
    *(0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 5, 0),
    *(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 6, 1, 0, 0),
    *(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 6, 18, 0, 3),
    *(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 6),
    *(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8, 0),
    *(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 15),
    *(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0),
)


class NetworkOperatorLaw(Block, interface=True):
    """Thrust and thrust angle from path angle and altitude, by a network operator of 16 nodes.

    With the angle θ of the velocity from the local vertical, altitude h, final altitude h_f, reference altitude h_0 and
    parameters q_1 to q_3 the sources are

        z_1 = π + θ    z_2 = q_1    z_3 = (h_f - h)/h_0    z_4 = q_2    z_5 = θ    z_6 = q_3

    The outputs are z_15, the angle from the local vertical to the thrust, limited to 0 to π, and z_16, the thrust minus
    nominal_thrust in kgf, limited to thrust_variation in magnitude.

    Assumes that altitude and path angle suffice: the law does not control range and cross-range.

    Source: Diveev, Pupkov and Sofronova 2013. See docs/systems/lunar_descent_2d.md.
    """

    matrix = Parameter(
        PUBLISHED_MATRIX,
        columns=SIZE,
        minimum=0,
        maximum=23,
        fixed="its edges are decoded once",
        description=(
            "network operator matrix by rows: unary operations above the diagonal, binary operations on the diagonal"
        ),
    )
    q = Parameter([1.50049, 13.54590, 12.96753], unit="1", description="parameters q of the control law")
    exp_saturation = Parameter(
        1,
        minimum=0,
        maximum=1,
        description="value of exp for arguments above ln 1e8: 0 selects 1e8, 1 selects ln 1e8 as in the published law",
    )
    reference_altitude = Parameter(
        18148.0, unit="m", minimum=1.0, description="reference altitude h0 by which altitudes are scaled"
    )
    nominal_thrust = Parameter(
        4314.926, unit="N", minimum=0.0, description="thrust commanded for output z16 = 0 of the law"
    )
    thrust_variation = Parameter(
        784.532, unit="N", minimum=0.0, description="largest deviation of the commanded thrust from nominal_thrust"
    )
    nodes = State([0.0] * SIZE, description="values of the network operator's nodes")
    edges = State([0] * MAXIMUM_EDGES, description="positions of the network operator's edges in the matrix, by rows")
    edge_count = State(0, description="number of the network operator's edges; -1: matrix is not a network operator")

    def decode_law(self) -> None:
        """Decode the matrix into edges and edge_count; call once, before `evaluate_law`."""
        self.edge_count = decode(self.matrix, self.edges)

    def evaluate_law(self, path_angle: float, altitude: float, final_altitude: float) -> None:
        """Evaluate the nodes for a path angle (rad) and altitudes (m), for a matrix that is a network operator."""
        for j in range(SOURCES, SIZE):
            self.nodes[j] = neutral(self.matrix[j, j])
        self.nodes[0] = math.pi + path_angle
        self.nodes[1] = self.q[0]
        self.nodes[2] = (final_altitude - altitude) / self.reference_altitude
        self.nodes[3] = self.q[1]
        self.nodes[4] = path_angle
        self.nodes[5] = self.q[2]
        exp_saturation = LARGEST
        if self.exp_saturation == 1:
            exp_saturation = LOG_LARGEST
        evaluate(self.matrix, self.edges, self.edge_count, exp_saturation, self.nodes)

    def law_angle(self) -> float:
        """Return the angle (rad) from the local vertical to the thrust."""
        return clip(self.nodes[14], 0.0, math.pi)

    def law_thrust(self) -> float:
        """Return the thrust (N)."""
        above = clip(KILOGRAM_FORCE * self.nodes[15], -self.thrust_variation, self.thrust_variation)
        return clip(self.nominal_thrust + above, 0.0, math.inf)
