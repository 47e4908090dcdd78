"""The discrete observer of yaw alone that follows each pulse."""

from .orbital_observer_discrete_reduced import OrbitalObserverDiscreteReduced


class OrbitalObserverDiscreteReducedSplit(OrbitalObserverDiscreteReduced):
    """Discrete observer of reduced order whose motion over a tick follows each pulse."""

    split = OrbitalObserverDiscreteReduced.split.with_start(True)
