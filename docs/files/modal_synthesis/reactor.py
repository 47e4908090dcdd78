"""A chemical reactor: Kautsky, Nichols and Van Dooren 1985, example 1."""

import numpy as np

reactor = np.array(
    [
        [1.380, -0.2077, 6.715, -5.676],
        [-0.5814, -4.290, 0.0, 0.6750],
        [1.067, 4.273, -6.654, 5.893],
        [0.0480, 4.273, 1.343, -2.104],
    ]
)
valves = np.array([[0.0, 5.679], [1.136, 1.136], [0.0, 0.0], [-3.146, 0.0]])
required = [-0.2, -0.5, -5.0566, -8.6659]
