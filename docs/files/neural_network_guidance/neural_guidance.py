"""Terminal guidance by a network fitted to the commands of the analytic law."""

from functools import cache

import numpy as np
from perilune import TerminalGuidance, TerminalStatus

from network import evaluate, features, frame, layers


@cache
def net(path):
    """Return the weights, which are read once."""
    with np.load(path) as file:
        return dict(file)


class NeuralGuidance(TerminalGuidance):
    """Thrust acceleration and time_to_go from a multilayer perceptron, for initial states like its training data."""

    python_only = True
    data = ("net.npz",)

    def solve(self) -> None:
        dr, dv = (np.array([*value]) for value in self.remaining())
        known = net(self.data_path("net.npz"))
        inputs = (features(dr, dv, self.gravity) - known["centre"]) / known["scale"]
        outputs = known["middle"] + known["spread"] * evaluate(layers(known["sizes"], known["weights"]), inputs)
        acceleration = self.gravity * outputs[:3] @ frame(dr)
        self.time_to_go = float(outputs[3] * np.sqrt(np.linalg.norm(dr) / self.gravity))
        self.command.thrust_acceleration = float(np.linalg.norm(acceleration))
        self.command.thrust_direction = acceleration / self.command.thrust_acceleration
        self.status = TerminalStatus.GOOD
