"""Fit of the network to the commands of the analytic guidance."""

from itertools import pairwise

import numpy as np
import perilune
from perilune.fmus_src.guidance.analytic import AnalyticGuidance
from scipy.optimize import minimize

from network import evaluate, features, frame, layers

SIZES, GRAVITY = (4, 24, 24, 4), 1.62
random = np.random.default_rng(1)
law = AnalyticGuidance(gravity=GRAVITY)
law.take_target()  # as at the start of a flight
inputs, commands = [], []
for _ in range(30):  # flights from the box of the campaign `paper`
    distance, azimuth = random.uniform(0.95e5, 1.05e5), random.uniform(-np.pi / 4, np.pi / 4)
    speed, heading = random.uniform(940.0, 960.0), azimuth + random.uniform(-np.pi / 18, np.pi / 18)
    altitude, descent = random.uniform(0.95e4, 1.15e4), random.uniform(0.0, 0.1)
    start = distance * np.cos(azimuth), distance * np.sin(azimuth), altitude
    velocity = -speed * np.array(
        [np.cos(descent) * np.cos(heading), np.cos(descent) * np.sin(heading), np.sin(descent)]
    )
    values = {f"plant.initial_position[{i + 1}]": float(start[i]) for i in range(3)}
    values |= {f"plant.initial_velocity[{i + 1}]": float(velocity[i]) for i in range(3)}
    flight = perilune.simulate("lunar_terminal_guidance", set=values)
    for n in range(0, len(flight.time) - 3, 40):
        position, velocity = flight["plant.position"][n], flight["plant.velocity"][n]
        law.position = position + random.normal(0.0, 0.02, 3) * np.linalg.norm(velocity)  # and nearby
        law.velocity = velocity * random.normal(1.0, 0.02, 3)
        law.solve()
        dr, dv = (np.array([*value]) for value in law.remaining())
        acceleration = law.command.thrust_acceleration * np.array([*law.command.thrust_direction])
        time = law.time_to_go * np.sqrt(GRAVITY / np.linalg.norm(dr))
        inputs.append(features(dr, dv, GRAVITY))
        commands.append([*(frame(dr) @ acceleration / GRAVITY), time])
x, y = np.array(inputs), np.array(commands)
centre, scale, middle, spread = x.mean(0), x.std(0), y.mean(0), y.std(0)
x, y = (x - centre) / scale, (y - middle) / spread


def misfit(weights):
    """Return the mean square of the residual commands, and its gradient by back-propagation."""
    stack, values = layers(SIZES, weights), [x]
    for matrix, offset in stack[:-1]:
        values.append(np.tanh(values[-1] @ matrix + offset))
    left = values[-1] @ stack[-1][0] + stack[-1][1] - y
    back, gradient = 2.0 * left / len(x), []
    for (matrix, _), value in zip(reversed(stack), reversed(values), strict=True):
        gradient = [(value.T @ back).ravel(), back.sum(0), *gradient]
        back = (back @ matrix.T) * (1.0 - value**2)
    return np.mean(np.sum(left**2, axis=1)), np.concatenate(gradient)


count = sum((inputs + 1) * outputs for inputs, outputs in pairwise(SIZES))
first = random.normal(0.0, 0.3, count)
fit = minimize(misfit, first, jac=True, method="L-BFGS-B", options={"maxiter": 400})
left = np.sqrt(np.mean((evaluate(layers(SIZES, fit.x), x) - y) ** 2, axis=0)) * spread
scales = {"centre": centre, "scale": scale, "middle": middle, "spread": spread}
np.savez("net.npz", sizes=SIZES, weights=fit.x, **scales)
time = 100.0 * left[3] / middle[3]
print(f"{len(x)} commands; rms error {np.linalg.norm(left[:3]):.4f} g, of time-to-go {time:.2f} %")
