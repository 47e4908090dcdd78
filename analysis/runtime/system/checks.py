"""Checks before a simulation: FMUs that do not fit their components, shared parameters, sample periods, faults."""

from __future__ import annotations

from collections.abc import Iterator

from fmpy import read_model_description

from ....common.errors import InputError, suggestion
from ....fmus_src.export.available import fmu_flavours
from ....fmus_src.roles import SAMPLE_PERIOD
from ...options.fault import Fault, number_text
from ..fmi.representations import TEXTS
from ..fmi.variable import ScalarVariable, variables_of
from ..ssp.names import split_name
from ..ssp.system_description import Component
from .network import Network
from .options import STEP_ROUNDING
from .passing.settings import SystemSettings

MOST = 6  # most FMUs that an error names


def unsuitable_fmu(slot: str, fmu: str, component: Component, error: InputError) -> InputError:
    """Return the error for an FMU that does not fit its component; ``error`` is the error in the description."""
    fits = list(_iterate_fitting_fmus(component))
    more = f" and {len(fits) - MOST} more" if len(fits) > MOST else ""
    remedy = f"these fit: {', '.join(fits[:MOST])}{more}" if fits else "no FMU here fits; build one with its connectors"
    reason = error.element.partition(" (line")[0]
    return InputError("`use`", f"{slot}={fmu}", f"it does not fit {slot}: {reason}: {error.problem}", remedy)


def missing_fmu(slot: str, fmu: str, component: Component) -> InputError:
    """Return the error for the missing FMU of a component; it suggests the most similar name of an FMU that fits."""
    remedy = f"of those that fit {slot} {suggestion(fmu, _iterate_fitting_fmus(component))}; or build your own"
    return InputError("`use`", f"{slot}={fmu}", "no such FMU is built", remedy)


def _iterate_fitting_fmus(component: Component) -> Iterator[str]:
    """Yield the names of the FMUs that have all connectors of a component."""
    required = {(connector.name, connector.kind) for connector in component.connectors.values()}
    for name, flavours in fmu_flavours().items():
        path = next((path for path in flavours.values() if path is not None), None)
        if path is not None:
            variables = variables_of(read_model_description(str(path), validate=False))
            if required <= {(variable.name, variable.causality) for variable in variables.values()}:
                yield name


def check_shared(network: Network, settings: SystemSettings) -> None:
    """Reject a value chosen by the user that a parameter of the system replaces.

    Values on which several components must agree are parameters of the system, so that no component can deviate. Raises
    InputError.
    """
    last = {assignment.name: assignment for assignment in settings.chosen}
    for (component, variable), (shared, value) in settings.replaced.items():
        name = f"{component}.{variable}"
        if name in last:
            readers = {link.target.name for link in network.driver.values() if link.source.name == shared} | {name}
            actual = settings.variables[component, variable]
            problem = (
                f"{value} differs from {actual}, the value that {shared} of the system passes to "
                f"{', '.join(sorted(readers))}"
            )
            raise InputError(last[name].file, last[name].where, problem, f"set {shared} instead, since both must agree")


def check_aliases(network: Network) -> None:
    """Reject an input of FMI 3.0 that is set under two of its names. Raises InputError."""
    for component, fmu in network.fmus.items():
        names: dict[tuple[int, int], str] = {}
        for name, variable in fmu.variables.items() if fmu.version == 3 else ():
            full = f"{component}.{name}"
            if variable.causality == "input" and (full in network.driver or full in network.driven):
                first = names.setdefault((variable.reference, variable.index), full)
                if first != full:
                    problem = f"is another name of {first}, which is also connected or driven"
                    raise InputError(network.file, full, problem, "connect one of them")


def check_samples(network: Network, settings: SystemSettings, step: float, periods: dict[str, int]) -> None:
    """Reject a sample period that is shorter than the step of its component.

    The FMU would take several samples in one step, and other components would only read the last. Raises InputError.
    """
    for component, fmu in network.fmus.items():
        variable = fmu.variables.get(SAMPLE_PERIOD)
        if variable is None or not fmu.is_own:
            continue
        period = float(settings.variables.get((component, SAMPLE_PERIOD), variable.start_text))
        own = step * periods.get(component, 1)
        if 0.0 < period < own * (1.0 - STEP_ROUNDING):
            file = settings.origins.get((component, SAMPLE_PERIOD), network.file)
            problem = f"{period:g} s is shorter than the communication step of {own:g} s"
            remedy = f"give a `step` of {period:g} or an integer submultiple of it, or a longer period"
            raise InputError(file, f"{component}.{SAMPLE_PERIOD}", problem, remedy)


def refuse_fixed(network: Network, name: str, where: tuple[str, str]) -> None:
    """Reject the name of a parameter that cannot be changed during simulation. Raises InputError."""
    component, short = split_name(name, network.fmus)
    variable = network.fmus[component].variables.get(short) if component else None
    if variable is not None and variable.causality == "parameter" and not variable.is_tunable:
        remedy = f"set it before the start by `set` {name}=VALUE, or use a tunable parameter"
        raise InputError(*where, "a parameter that is fixed after initialisation", remedy)


def changeable(network: Network, name: str, where: tuple[str, str], *, tunable: bool = False) -> ScalarVariable:
    """Return the variable of a connector, ``component.connector``, that can be changed during simulation.

    Such variables are outputs, inputs that are connected or driven and, with ``tunable``, tunable parameters. ``where``
    (file, element) is named in errors. Raises InputError.
    """
    known: dict[str, ScalarVariable] = {}
    for component, fmu in network.fmus.items():
        for variable in fmu.variables.values():
            full = f"{component}.{variable.name}"
            fed = variable.causality == "input" and (full in network.driver or full in network.driven)
            parameter = tunable and variable.is_tunable
            if (fed or parameter or variable.causality == "output") and variable.type not in TEXTS:
                known[full] = variable
    if name in known:
        return known[name]
    if tunable:
        refuse_fixed(network, name, where)
    component, own = split_name(name, network.fmus)
    unfed = network.fmus[component].variables.get(own) if component else None
    if unfed is not None and unfed.causality == "input":
        raise InputError(
            *where, "an input that nothing is connected to", f"give the input a value with `set` {name}=VALUE"
        )
    raise InputError(*where, "no component has such a connector", suggestion(name, known))


def check_value(variable: ScalarVariable, kind: str, value: float | bool, where: tuple[str, str]) -> None:
    """Reject a value that a connector cannot have. ``where`` is as in `changeable`. Raises InputError."""
    if kind == "freeze":
        return
    type_name, stored = variable.type, variable.representation
    if type_name == "Boolean":
        if kind == "bias":
            raise InputError(*where, "a Boolean has no bias", "use override:true or override:false")
        if value not in (0, 1):
            raise InputError(*where, f"{number_text(value)} is not a Boolean", "give true or false")
    elif isinstance(value, bool):
        raise InputError(*where, f"{number_text(value)} is not of type {type_name}", "give a number")
    elif type_name != "Real" and not (value == round(value) and stored.limits[0] <= value <= stored.limits[1]):
        raise InputError(*where, f"{number_text(value)} is not of type {type_name}", f"give {stored.describe_range()}")
    if variable.is_tunable and kind == "override":
        check_bounds(variable, float(value), where)


def check_bounds(variable: ScalarVariable, number: float, where: tuple[str, str]) -> None:
    """Reject a value of a tunable parameter outside its declared bounds. Raises InputError."""
    low, high = (None if text is None else float(text) for text in (variable.minimum, variable.maximum))
    if low is not None and number < low:
        raise InputError(*where, f"{number:.12g} is below its minimum {low:.12g}", "give a larger value")
    if high is not None and number > high:
        raise InputError(*where, f"{number:.12g} is above its maximum {high:.12g}", "give a smaller value")


def check_fault(network: Network, fault: Fault) -> None:
    """Reject a fault that the system cannot have. Raises InputError."""
    where = ("fault", fault.name)
    check_value(changeable(network, fault.name, where, tunable=True), fault.kind, fault.value, where)
