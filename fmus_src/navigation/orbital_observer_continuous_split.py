"""The continuous observer that follows each pulse."""

from .orbital_observer_continuous import OrbitalObserverContinuous


class OrbitalObserverContinuousSplit(OrbitalObserverContinuous):
    """Continuous observer of the whole state, integrated between the switch-offs of the jets."""

    split = OrbitalObserverContinuous.split.with_start(True)
