"""A multilayer perceptron in numpy."""

from itertools import pairwise

import numpy as np


def layers(sizes, weights):
    """Return the matrix and the offsets of each layer, from one vector of weights."""
    stack, start = [], 0
    for inputs, outputs in pairwise(sizes):
        end = start + inputs * outputs
        stack.append((weights[start:end].reshape(inputs, outputs), weights[end : end + outputs]))
        start = end + outputs
    return stack


def evaluate(stack, x):
    """Return the outputs for inputs x, a row each; hidden layers apply tanh."""
    for matrix, offset in stack[:-1]:
        x = np.tanh(x @ matrix + offset)
    return x @ stack[-1][0] + stack[-1][1]


def frame(dr):
    """Return a matrix whose rows point towards the target along the ground, to the left of it, and up."""
    forward = dr * [1.0, 1.0, 0.0]
    forward /= np.linalg.norm(forward)
    up = np.array([0.0, 0.0, 1.0])
    return np.array([forward, np.cross(up, forward), up])


def features(dr, dv, gravity):
    """Return the dimensionless inputs of the network, independent of the direction to the site."""
    length = np.linalg.norm(dr)
    return np.concatenate([[dr[2] / length], frame(dr) @ dv / np.sqrt(gravity * length)])
