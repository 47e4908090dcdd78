"""Earth, Sun and Moon in Basilisk, as our side hands them over. Runs in Basilisk's environment."""

import numpy as np
from Basilisk.architecture import messaging, sysModel
from Basilisk.simulation import gravityEffector, spacecraft, sphericalHarmonicsGravityModel
from Basilisk.utilities import macros

from crosscheck.basilisk_side import Flight

NAMES = ("earth", "sun", "moon")


class Surroundings(sysModel.SysModel):
    """Messages of Earth, Sun and Moon: at the begin of a step what our side has for it.

    Sun and Moon stay over a step where they are in its middle, as here; the Earth turns on linearly, as Basilisk does.
    """

    def __init__(self, given: dict, step: float) -> None:
        super().__init__()
        self.ModelTag = "surroundings"
        self.given, self.length = given, macros.sec2nano(step)
        self.messages = {name: messaging.SpicePlanetStateMsg() for name in NAMES}
        self.write(0)

    def write(self, now: int) -> None:
        """Write the messages of the step that begins at a time (ns), if there is one."""
        row = round(now / self.length)
        if row >= len(self.given["sun"]):
            return
        for name, message in self.messages.items():
            state = messaging.SpicePlanetStateMsgPayload()
            state.PlanetName = name
            if name == "earth":
                state.J20002Pfix, state.J20002Pfix_dot = self.given["axes"][row], self.given["axes_rate"][row]
            else:
                state.PositionVector = self.given[name][row]
                state.J20002Pfix = np.eye(3).tolist()
            message.write(state, now, self.moduleID)

    def UpdateState(self, now: int) -> None:  # noqa: N802
        """Write the messages of the next step."""
        self.write(now)


def surround(flight: Flight, given: dict, step: float, degree: int) -> Surroundings:
    """Attract a craft by an Earth with spherical harmonics to a degree, Sun and Moon; update them after the craft."""
    surroundings = Surroundings(given, step)
    flight.add(surroundings, priority=0)
    bodies = []
    for name in NAMES:
        body = gravityEffector.GravBodyData()
        body.planetName, body.mu = name, given[f"{name}_mu"]
        body.planetBodyInMsg.subscribeTo(surroundings.messages[name])
        if name == "earth":
            body.isCentralBody, body.radEquator = True, given["radius"]
            body.gravityModel = harmonics(given["normalised"], body.mu, given["radius"], degree)
        bodies.append(body)
    flight.craft.gravField.gravBodies = spacecraft.GravBodyVector(bodies)
    return surroundings


def harmonics(normalised: list[float], mu: float, radius: float, degree: int) -> object:
    """Return the model of gravity: C, S of orders 0 to n for each degree n from 2 on; mu in m3/s2, radius in m."""
    c, s = [[1.0], [0.0, 0.0]], [[0.0], [0.0, 0.0]]
    pairs = iter(zip(normalised[0::2], normalised[1::2], strict=True))
    for n in range(2, degree + 1):
        row = [next(pairs) for _ in range(n + 1)]
        c.append([each for each, _ in row])
        s.append([each for _, each in row])
    model = sphericalHarmonicsGravityModel.SphericalHarmonicsGravityModel()
    model.cBar, model.sBar, model.maxDeg = c, s, degree
    model.muBody, model.radEquator = mu, radius
    return model
