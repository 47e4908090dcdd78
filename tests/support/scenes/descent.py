"""A flight made by hand with a scene that has everything a scene can have, under any name."""

import numpy as np

from perilune.analysis.reports.figures.scene.declared import Jets, Line, Site, Thrust, ThrustAxis
from tests.support.scenes.made import body, cartesian, flown, scalar, scene, sphere, vector


def descent(name="ship", rows=20, **more):
    """A lander comes down over a round body: the run, half a second a row, and its scene."""
    along = np.linspace(0.0, 1.0, rows)
    result = flown(
        position=[100.0 * along, 0.0 * along, 50.0 * (1.0 - along)],
        axis=[0.1 * along, 0.0 * along, 1.0 + along],
        thrust=400.0 * (1.0 - along),
        lengths=0.1 * (along > 0.5),
        on=along > 0.3,
    )
    lander = body(
        name,
        cartesian(),
        ThrustAxis(vector("ship.axis", 3)),
        shape="lander",
        thrusts=(Thrust(scalar("ship.thrust"), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)),),
        jets=(Jets(scalar("ship.lengths"), ((1.0, 0.0, 0.0),), ((0.0, 1.0, 0.0),), True, None, True),),
    )
    site = Site(f"{name}'s site", (100.0, 0.0, 0.0))
    line = Line(f"{name}'s beam", name, "ground", scalar("ship.on"))
    declared = {"title": f"Landing of {name}", "frame": name, "surface": sphere(1e6)}
    return result, scene(lander, **(declared | {"sites": (site,), "lines": (line,)} | more))
