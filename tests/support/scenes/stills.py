"""Contents of the pictures of a scene on a page, read from their SVG."""

import re

import numpy as np

WIDTH, HEIGHT = 400.0, 260.0


def points_of(commands):
    """Return the points of a path, [n, 2]: right of the picture's middle and below it, over its height."""
    numbers = np.array(re.findall(r"-?[\d.]+", commands), dtype=float).reshape(-1, 2)
    return (numbers - [WIDTH / 2, HEIGHT / 2]) / HEIGHT


def arrow_tips(text):
    """Return the ends of all arrows, in the order of the text; each is drawn twice, faintly over what hides it."""
    return [points_of(each)[1] for each in re.findall(r'class="arrow" d="([^"]*)"', text)]
