"""A component as the reference loop sees it, and the ways in which it ends a flight."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping

from fmpy.fmi1 import FMICallException

Sample = float | int | bool | str | bytes  # a whole number of 64 bits is an int, which no float64 need be
Samples = dict[str, Sample]  # by the names of variables, elements of arrays one by one


class FailedError(Exception):
    """Refusal of a component, or of a connection: the flight ends ``failed``."""


class NonFiniteError(Exception):
    """Number that is not finite, or beyond the type of the variable that is to have it: ``nonfinite``."""


class EndedError(Exception):
    """Wish of a ``component`` to end the simulation at a ``time`` (s): ``terminated``, with one last row."""

    def __init__(self, component: str, time: float) -> None:
        super().__init__(component)
        self.component, self.time = component, time


REFUSALS = (FailedError, NonFiniteError, FMICallException)


class Component(ABC):
    """One instance of an FMU, which manages its modes: a loop calls these methods in the order of this file.

    Other masters have such an interface, too: libcosim's `algorithm` calls a `slave` by it, Ecos a `model_instance`.

    `initialise` once; `set` and `get` in initialisation mode; `settle` once; then `set`, `step` and `get` of every
    step. Mappings are the caller's: a component keeps none, and returns a new one. A call that the FMU refuses raises
    FMPy's FMICallException, after which no method is called. The creator of a component terminates and frees its
    instance.
    """

    @abstractmethod
    def initialise(self, start: float, stop: float) -> None:
        """Set the parameters and enter initialisation mode, for a flight between two times (s).

        Called of every component before `set` of any.
        """

    @abstractmethod
    def set(self, values: Mapping[str, Sample]) -> None:
        """Give all inputs that are connected or driven, and parameters that change in flight.

        Called in initialisation mode, then once before every step: with values of the step's start of components
        that step together, with those of its end of components behind them. Raises NonFiniteError, EndedError.
        """

    @abstractmethod
    def get(self, names: Iterable[str]) -> Samples:
        """Return variables at the time that the component has reached.

        Called in initialisation mode, where all inputs have been set, then behind `settle` and behind every step.
        """

    @abstractmethod
    def settle(self) -> None:
        """Leave initialisation mode for step mode, by way of event mode where that is used; read the parameters back.

        Called of every component when all outputs of the start have been exchanged. Raises FailedError for a parameter
        that the FMU has not taken, EndedError.
        """

    @abstractmethod
    def step(self, begin: float, size: float, end: float) -> None:
        """Advance by a step (s) from one time (s) to another, which carry rounding, with the inputs that it has.

        Raises EndedError, FailedError.
        """
