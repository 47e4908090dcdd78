"""The discrete observer that follows each pulse."""

from .orbital_observer_discrete import OrbitalObserverDiscrete


class OrbitalObserverDiscreteSplit(OrbitalObserverDiscrete):
    """Discrete observer of the whole state whose motion over a tick follows each pulse."""

    split = OrbitalObserverDiscrete.split.with_start(True)
