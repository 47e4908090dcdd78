"""Truth of a law declared as a network operator: every operation by numpy, from the outputs backwards."""

import numpy as np

from tests.support.checks.check import STEP, Check, follow
from tests.support.laws.operations import FORMULAS, NEUTRAL, backwards

STANDARD_GRAVITY, NOMINAL = 9.80665, 4314.926

# Every unary and every binary operation: (row, column) counted from 0 -> operation.
BINARY = [0, 0, 0, 0, 0, 0, 3, 1, 1, 1, 0, 2, 0, 2, 0, 0]
EDGES = {
    (1, 9): 2, (2, 12): 16, (3, 6): 1, (3, 9): 11, (3, 14): 14, (3, 15): 13, (4, 6): 17, (4, 8): 21, (4, 11): 20,
    (4, 12): 19, (6, 7): 7, (7, 8): 19, (7, 10): 5, (8, 15): 12, (9, 10): 6, (9, 11): 23, (9, 15): 15, (10, 11): 3,
    (10, 12): 1, (10, 14): 10, (10, 15): 1, (11, 12): 9, (11, 14): 18, (12, 14): 4, (12, 15): 8,
}  # fmt: skip


def planar_network_operator():
    """Check all operations; replacing any of them by another one shows in the commands."""
    q, reference, final, variation = [1.5, -0.75, 2.5], 18148.0, 1500.0, 60.0
    random = np.random.default_rng(28)
    angles = np.concatenate([random.uniform(-3.0, 0.5, 37).round(3), [0.0, -1.5, -1.6]])
    altitudes = np.concatenate([random.uniform(-500.0, 20000.0, 37).round(1), [8000.0, 1500.0, 1501.0]])
    matrix = np.diag(BINARY)
    for edge, operation in EDGES.items():
        matrix[edge] = operation

    def law(matrix):
        sources = (
            [np.pi + a, q[0], (final - h) / reference, q[1], a, q[2]] for a, h in zip(angles, altitudes, strict=True)
        )
        values = [backwards(matrix.tolist(), row) for row in sources]
        return np.array([(value_of(14), STANDARD_GRAVITY * value_of(15)) for value_of in values]).T

    def commands(matrix):
        angle, above = law(matrix)
        return np.array([angle.clip(0.0, np.pi), NOMINAL + above.clip(-variation, variation)])

    assert set(EDGES.values()) == set(FORMULAS)
    assert set(BINARY) == set(NEUTRAL)
    shows = set()
    for position in [*EDGES, *((node, node) for node in range(6, 16))]:
        others = matrix.copy()
        others[position] = {1: 3, 0: 1}.get(matrix[position], int(position in EDGES))
        if np.abs(commands(others) - commands(matrix)).max() > 1e-3:
            shows.add(position)
    assert shows >= set(EDGES)
    assert {BINARY[node] for node, other in shows if node == other} == set(NEUTRAL)
    angle, above = law(matrix)
    assert (angle < 0.0).any()
    assert (angle > np.pi).any()
    assert (above > variation).any()
    assert (above < -variation).any()
    thrust_angle, thrust = commands(matrix)
    outputs = {"thrust_angle": follow(thrust_angle), "thrust": follow(thrust), "status": np.zeros(len(angles))}
    return Check(
        truth="operations by numpy, from the outputs backwards",
        step=STEP,
        inputs={"measured_path_angle": angles, "measured_altitude": altitudes},
        outputs=outputs,
        tolerances={"thrust_angle": (1e-13, 0.0), "thrust": (1e-11, 0.0), "status": (0.0, 0.0)},
        parameters={
            "matrix": matrix,
            "q": q,
            "exp_saturation": 0,
            "reference_altitude": reference,
            "final_altitude": final,
            "nominal_thrust": NOMINAL,
            "thrust_variation": variation,
        },
    )


TRUTHS = {"planar_network_operator": planar_network_operator}
