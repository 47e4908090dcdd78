"""Hand-written run with a scene that contains every kind of element, under any name."""

import numpy as np

from perilune.analysis.documents.figures.scene.scene_elements import Arrow, Jets, Line, Panel, Site, Thrust, ThrustAxis
from tests.support.scenes.made import body, cartesian, flown, scalar, scene, sphere, vector


def descent(name="ship", rows=20, **more):
    """Return the run of a lander that comes down over a round body, half a second a row, and its scene."""
    along = np.linspace(0.0, 1.0, rows)
    result = flown(
        position=[100.0 * along, 0.0 * along, 50.0 * (1.0 - along)],
        axis=[0.1 * along, 0.0 * along, 1.0 + along],
        thrust=400.0 * (1.0 - along),
        lengths=0.1 * (along > 0.5),
        on=along > 0.3,
        wind=[2.0 + along, -1.0 + 0.0 * along, 0.5 + along],
    )
    lander = body(
        name,
        cartesian(),
        ThrustAxis(vector("ship.axis", 3)),
        shape="lander",
        panels=(Panel((0.0, 1.4, 2.0), (1.0, 0.1, 1.0)),),
        thrusts=(Thrust(scalar("ship.thrust"), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)),),
        jets=(Jets(scalar("ship.lengths"), ((1.0, 0.0, 0.0),), ((0.0, 1.0, 0.0),), True, None, True),),
    )
    site = Site(f"{name}'s site", (100.0, 0.0, 0.0))
    line = Line(f"{name}'s beam", name, "ground", scalar("ship.on"))
    arrow = Arrow(f"{name}'s wind", name, vector("ship.wind", 3), None, None, "green")
    declared = {"title": f"Landing of {name}", "frame": name, "surface": sphere(1e6)}
    return result, scene(lander, **(declared | {"sites": (site,), "lines": (line,), "arrows": (arrow,)} | more))
