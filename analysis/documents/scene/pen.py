"""SVG elements for pictures of a scene: size, colours of light and dark pages, paths and names."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup

from .view import BodyView, SceneView, SiteView, position_at

WIDTH, HEIGHT = 400.0, 260.0  # units of the picture
SKY, LAND = "light-dark(#eef2f6, #0d1117)", "light-dark(#d8d4cc, #3a3936)"
INK, BEAM = "light-dark(#222, #e6e6e6)", "light-dark(#c92a2a, #ff8787)"
AXES = ("light-dark(#d9480f, #ff922b)", "light-dark(#2b8a3e, #69db7c)", "light-dark(#1c6fd0, #74c0fc)")


def to_units(points: np.ndarray) -> np.ndarray:
    """Return points of `Camera.project`, [n, 2], in units of the picture."""
    return np.asarray(points * HEIGHT + [WIDTH / 2.0, HEIGHT / 2.0])


def path(points: np.ndarray) -> str:
    """Return the commands of a line through points of `Camera.project`, [n, 2]."""
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in to_units(points))


def text(label: str, x: float, y: float, kind: str = "name", colour: str = INK) -> Markup:
    """Return a centred name with an outline in the colour of the sky."""
    markup = Markup('<text class="{}" x="{:.1f}" y="{:.1f}" style="fill:{};stroke:{}">{}</text>')
    return markup.format(kind, x, y, colour, SKY, label)


def lighter(colour: str) -> str:
    """Return a colour that is a quarter lighter on dark pages."""
    light = "#" + "".join(f"{round(0.75 * int(colour[k : k + 2], 16) + 0.25 * 255):02x}" for k in (1, 3, 5))
    return f"light-dark({colour}, {light})"


def point_of(scene: SceneView, name: str, row: int) -> np.ndarray:
    """Return the position (m), [3], of a body or a site by name."""
    points: list[BodyView | SiteView] = [*scene.bodies, *scene.sites]
    return next(position_at(each, row) for each in points if each.name == name)
