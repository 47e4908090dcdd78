"""Bundles: ports that are connected together, declared once for all sources and targets.

    class ThrustCommand(Bundle):
        thrust_acceleration = Port(0.0, unit="m/s2", description="commanded thrust acceleration (thrust over mass)")
        burn_duration = Port(0.0, unit="s", description="commanded burn duration")

    command = Outputs(ThrustCommand, direct=True)
    braking = Inputs(ThrustCommand, prefix="braking_", about="command of the braking guidance:")

Each port becomes a separate variable, such as ``braking_burn_duration``, which kernels read and assign as
``self.braking.burn_duration``. ``self.command = self.braking`` assigns all of them.
"""

from __future__ import annotations

from operator import attrgetter
from typing import Any, ClassVar, Generic, TypeVar

from .ports import Port
from .variables import DeclarationError, Input, Output


class Bundle:
    """Base of bundles; a subclass declares the ports that are connected together."""

    ports: ClassVar[dict[str, Port]] = {}

    def __init_subclass__(cls) -> None:
        cls.ports = {name: port for name, port in vars(cls).items() if isinstance(port, Port)}


B = TypeVar("B", bound=Bundle)


class Connectors(Generic[B]):
    """Variables of a block for the ports of a bundle.

    ``prefix`` and ``about`` are prepended to the names and descriptions of the ports; ``starts`` contains the start
    values that differ from the bundle's.
    """

    def __init__(self, bundle: type[B], *, prefix: str = "", about: str = "", **starts: Any) -> None:
        self.bundle = bundle
        self.names = {member: f"{prefix}{member}" for member in bundle.ports}
        self.about = about
        self.starts = starts
        self.view = _make_view(bundle, self.names)

    def declare(self, owner: type, name: str) -> None:
        """Add the variables to the block class ``owner``, in which this bundle is the attribute ``name``."""
        where = f"{owner.__name__}.{name}"
        for unknown in self.starts.keys() - self.names.keys():
            raise DeclarationError(f"{where}: {self.bundle.__name__} has no {unknown}; it has {', '.join(self.names)}")
        for member, port in self.bundle.ports.items():
            full = self.names[member]
            if full in vars(owner):
                raise DeclarationError(f"{where}: {full} is declared twice; give the bundle another prefix")
            description = f"{self.about} {port.declaration.get('description', '')}".strip()
            variable = self.make(port, description, self.starts.get(member))
            setattr(owner, full, variable)
            variable.__set_name__(owner, full)

    def make(self, port: Port, description: str, start: Any) -> Input | Output:
        """Create the variable of a port."""
        raise NotImplementedError

    def __get__(self, instance: Any, owner: type | None = None) -> B:
        return self if instance is None else self.view(instance)  # type: ignore[return-value]

    def __set__(self, instance: Any, view: B) -> None:
        if getattr(view, "bundle", None) is not self.bundle:
            members = ", ".join(self.names.values())
            raise TypeError(f"{instance.fmu_name}: give a {self.bundle.__name__} of a block, or assign {members}")
        for member, name in self.names.items():
            setattr(instance, name, getattr(view, member))


class Inputs(Connectors[B]):
    """Inputs of a block for the ports of a bundle."""

    def make(self, port: Port, description: str, start: Any) -> Input:
        return port.input(description, start=start)


class Outputs(Connectors[B]):
    """Outputs of a block for the ports of a bundle; ``direct`` has the same meaning as for an `Output`."""

    def __init__(self, bundle: type[B], *, direct: bool | tuple[str, ...] = False, **declaration: Any) -> None:
        super().__init__(bundle, **declaration)
        self.direct = direct

    def make(self, port: Port, description: str, start: Any) -> Output:
        return port.output(description, start=start, direct=self.direct)


class _View:
    """Access to the variables of a bundle in one block."""

    __slots__ = ("_block",)
    bundle: ClassVar[type[Bundle]]

    def __init__(self, block: Any) -> None:
        self._block = block


def _make_view(bundle: type[Bundle], names: dict[str, str]) -> type[_View]:
    """Return a class of views with one property for each of the block's variables."""
    members: dict[str, Any] = {member: _make_property(name) for member, name in names.items()}
    return type(bundle.__name__, (_View,), {"__slots__": (), "bundle": bundle, **members})


def _make_property(name: str) -> property:
    def assign(view: _View, value: Any) -> None:
        setattr(view._block, name, value)

    return property(attrgetter(f"_block.{name}"), assign)
