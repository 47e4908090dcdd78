"""Interface of a component to the reference loop, and the exceptions with which it ends a simulation."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping

from fmpy.fmi1 import FMICallException

Sample = float | int | bool | str | bytes  # a 64-bit integer is an int, since float64 may not represent it
Samples = dict[str, Sample]  # by variable name, with separate array elements


class FailedError(Exception):
    """Error of a component or a connection, which ends the simulation with the status ``failed``."""


class NonFiniteError(Exception):
    """Number that is not finite or exceeds its target's type; ends the simulation with the status ``nonfinite``."""


class TerminationError(Exception):
    """Request of a ``component`` to end the simulation at ``time`` (s), with one last row.

    The status is then ``terminated``.
    """

    def __init__(self, component: str, time: float) -> None:
        super().__init__(component)
        self.component, self.time = component, time


REFUSALS = (FailedError, NonFiniteError, FMICallException)


class ComponentInstance(ABC):
    """Instance of an FMU, which manages its own modes.

    Similar interfaces in other masters are `slave`, which libcosim's `algorithm` calls, and `model_instance` of Ecos.
    The loop calls the methods in the order of this class: `initialise` once, `set` and `get` in initialisation mode,
    `settle` once, then `set`, `step` and `get` in every step. A component does not retain the mappings that it
    receives, and returns new ones. If the FMU rejects a call, FMPy's FMICallException is raised, and no method is
    called any more. The creator of a component terminates and frees its instance.
    """

    @abstractmethod
    def initialise(self, start: float, stop: float) -> None:
        """Set the parameters and enter initialisation mode for a simulation from ``start`` to ``stop`` (s).

        This method is called for all components before `set` is called for any of them.
        """

    @abstractmethod
    def set(self, values: Mapping[str, Sample]) -> None:
        """Set all inputs that are connected or driven, and parameters that change during simulation.

        This method is called in initialisation mode, and once before every step. Components that step together get the
        values at the start of the step, components that follow others get the values at its end. Raises NonFiniteError,
        TerminationError.
        """

    @abstractmethod
    def get(self, names: Iterable[str]) -> Samples:
        """Return variables at the time that the component has reached.

        This method is called in initialisation mode once all inputs are set, after `settle`, and after every step.
        """

    @abstractmethod
    def settle(self) -> None:
        """Leave initialisation mode for step mode, through event mode if it is used; check the parameters.

        This method is called for all components once all initial outputs have been exchanged. Raises FailedError if the
        FMU did not accept a parameter, and TerminationError.
        """

    @abstractmethod
    def step(self, begin: float, size: float, end: float) -> None:
        """Advance by ``size`` (s) from ``begin`` to ``end`` (s, both subject to rounding) with the current inputs.

        Raises TerminationError, FailedError.
        """
