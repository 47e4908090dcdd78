"""Which faults a system can have: connectors, their types, and values that fit them."""

from __future__ import annotations

from ...common.errors import InputError, suggestion
from .fault import Fault, number_text
from .names import split_name
from .network import Network

INTEGERS = (-(2**31), 2**31 - 1)  # FMI Integers have 32 bits


def connector_type(network: Network, name: str, where: tuple[str, str]) -> str:
    """The FMI type of a component's connector, ``component.connector``, whose value can be changed on its way.

    These are outputs, and inputs that something is connected to or a series drives. ``where`` (file, element) is what
    errors point to. Raises InputError.
    """
    known: dict[str, str] = {}
    for component, fmu in network.fmus.items():
        for variable in fmu.variables.values():
            full = f"{component}.{variable.name}"
            fed = variable.causality == "input" and (full in network.driver or full in network.driven)
            if (fed or variable.causality == "output") and variable.type != "String":
                known[full] = variable.type
    if name in known:
        return known[name]
    component, own = split_name(name, network.fmus)
    variable = network.fmus[component].variables.get(own) if component else None
    if variable is not None and variable.causality == "input":
        raise InputError(*where, "an input that nothing is connected to", f"give it a value with `set` {name}=VALUE")
    raise InputError(*where, "no such connector of a component", suggestion(name, known))


def check_value(type_name: str, kind: str, value: float | bool, where: tuple[str, str]) -> None:
    """Refuse a value that a connector of a type cannot have. ``where`` as in `connector_type`. Raises InputError."""
    if kind == "freeze":
        return
    if type_name == "Boolean":
        if kind == "bias":
            raise InputError(*where, "a Boolean has no bias", "use override:true or override:false")
        if value not in (0, 1):
            raise InputError(*where, f"{number_text(value)} is not a Boolean", "give true or false")
    elif isinstance(value, bool):
        raise InputError(*where, f"{number_text(value)} is not of type {type_name}", "give a number")
    elif type_name != "Real" and not (value == round(value) and INTEGERS[0] <= value <= INTEGERS[1]):
        raise InputError(*where, f"{number_text(value)} is not of type {type_name}", "give a whole number of 32 bits")


def check_fault(network: Network, fault: Fault) -> None:
    """Refuse a fault that the system cannot have. Raises InputError."""
    where = ("fault", fault.name)
    check_value(connector_type(network, fault.name, where), fault.kind, fault.value, where)
