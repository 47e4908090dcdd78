"""Contestants without further software: Perilune's loop and FMPy."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

from fmpy.fmi2 import FMU2Slave
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import Parameter, ParameterSet

from perilune.analysis.options.choices import FUSED
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.fmu import Fmu
from perilune.common.errors import InputError

from ..contestant import Contestant, ExchangeSystem, Fly, Unavailable, Values


def prepare_loop(course: ExchangeSystem, algorithm: str = "sequential", flavour: str | None = None) -> Fly:
    """Prepare a `Simulation` that reuses its instances and, like other contestants, continues after ``finished``."""
    prepared = course.flight(1, algorithm)
    prepared = replace(prepared, options=replace(prepared.options, flavour=flavour))
    try:
        simulation = Simulation(prepared, requested=course.names)
    except InputError as error:
        raise Unavailable(str(error)) from error
    simulation.ignore_finished()

    def fly(steps: int) -> Values:
        simulation.prepared = course.flight(steps, algorithm)
        result = simulation.fly(every=max(1, steps))
        if not result.complete:
            raise RuntimeError(f"{result.status}: {result.message}")
        return {name: float(values[-1]) for name, values in result.signals.items()}

    return fly


@dataclass
class _Unit:
    """FMU with precomputed value references and positions in the common list of values."""

    slave: FMU2Slave
    inputs: list[int]
    sources: list[int]
    outputs: list[int]
    first: int  # outputs are consecutive in the list of values
    parameters: dict[str, dict[int, float | int | bool | str]]  # by type and value reference

    def set_inputs(self, values: list[float]) -> None:
        self.slave.setReal(self.inputs, [values[source] for source in self.sources])

    def get_outputs(self, values: list[float]) -> None:
        values[self.first : self.first + len(self.outputs)] = self.slave.getReal(self.outputs)


def prepare_calls(course: ExchangeSystem) -> Fly:
    """Prepare one call each of setReal, doStep and getReal per FMU and step, in Perilune's sequential order."""
    prepared = course.prepared
    places: dict[str, int] = {}
    for component in prepared.network.fmus:
        for name in course.names:
            if name.startswith(f"{component}."):
                places[name] = len(places)
    units = {component: _unit(course, component, fmu, places) for component, fmu in prepared.network.fmus.items()}
    initial = [units[name] for name in prepared.schedule.initial_order]
    sources = [units[name] for name in prepared.schedule.sources_first]
    followers = [units[name] for name in prepared.schedule.followers]
    start, step = prepared.start, prepared.step

    def fly(steps: int) -> Values:
        values = [0.0] * len(places)
        for unit in initial:
            unit.slave.reset()
            unit.slave.setReal(list(unit.parameters["Real"]), list(unit.parameters["Real"].values()))
            unit.slave.setInteger(list(unit.parameters["Integer"]), list(unit.parameters["Integer"].values()))
            unit.slave.setBoolean(list(unit.parameters["Boolean"]), list(unit.parameters["Boolean"].values()))
            unit.slave.setString(list(unit.parameters["String"]), list(unit.parameters["String"].values()))
            unit.slave.setupExperiment(startTime=start, stopTime=start + steps * step)
            unit.slave.enterInitializationMode()
        for unit in initial:
            unit.set_inputs(values)
            unit.get_outputs(values)
        for unit in initial:
            unit.slave.exitInitializationMode()
        for n in range(steps):
            time = start + n * step
            for unit in sources:
                unit.set_inputs(values)
                unit.slave.doStep(time, step)
            for unit in sources:
                unit.get_outputs(values)
            for unit in followers:
                unit.set_inputs(values)
                unit.slave.doStep(time, step)
                unit.get_outputs(values)
        return {name: values[place] for name, place in places.items()}

    return fly


def _unit(course: ExchangeSystem, component: str, fmu: Fmu, places: dict[str, int]) -> _Unit:
    slave = FMU2Slave(
        guid=fmu.description.guid,
        unzipDirectory=str(fmu.folder),
        modelIdentifier=fmu.description.coSimulation.modelIdentifier,
        instanceName=component,
    )
    slave.instantiate()
    links = [link for link in course.links if link.target.component == component]
    mine = {name: place for name, place in places.items() if name.startswith(f"{component}.")}
    parameters: dict[str, dict[int, float | int | bool | str]] = {
        kind: {} for kind in ("Real", "Integer", "Boolean", "String")
    }
    for (owner, name), value in course.settings().items():
        if owner == component:
            variable = fmu.variables[name]
            kind = "Integer" if variable.type == "Enumeration" else variable.type
            parameters[kind][variable.reference] = value
    return _Unit(
        slave=slave,
        inputs=[fmu.variables[link.target.variable].reference for link in links],
        sources=[places[link.source.name] for link in links],
        outputs=[fmu.variables[name.removeprefix(f"{component}.")].reference for name in mine],
        first=min(mine.values(), default=0),
        parameters=parameters,
    )


def prepare_ssp(course: ExchangeSystem) -> Fly:
    """Prepare simulate_ssp, which unpacks and instantiates the FMUs for every simulation.

    Parameters are passed explicitly, since simulate_ssp does not read the bindings of the SSD. It sets all inputs to 0
    in the first step, exchanges values after all FMUs have stepped, and records every connector.
    """
    parameters = ParameterSet(
        name="benchmark",
        parameters=[
            Parameter(name=f"{component}.{variable}", value=value)
            for (component, variable), value in course.settings().items()
        ],
    )
    start, step = course.prepared.start, course.prepared.step

    def fly(steps: int) -> Values:
        # it accumulates the time and stops once that reaches the stop time
        stop = start + (steps - 0.5) * step
        rows = simulate_ssp(str(course.ssp), start, stop, step, parameters)
        if len(rows) != steps:
            raise RuntimeError(f"simulate_ssp made {len(rows)} steps instead of {steps}")
        return {name: float(rows[-1][name]) for name in course.names}

    return fly


FMPY_SSP = Contestant(
    "fmpy_simulate_ssp",
    "python",
    "FMPy's simulate_ssp: one call per variable, every connector recorded",
    None,
    prepare_ssp,
)
FMPY_CALLS = Contestant(
    "fmpy_calls",
    "python",
    "FMPy's calls in a hand-written loop: one setReal, doStep, getReal per FMU",
    "sequential",
    prepare_calls,
)
LOOPS = (
    Contestant(
        "perilune_jacobi_python",
        "python",
        "the compiled loop of this project, exchanging after all have stepped",
        "jacobi",
        partial(prepare_loop, algorithm="jacobi"),
    ),
    Contestant(
        "perilune_python",
        "python",
        "the compiled loop of this project",
        "sequential",
        prepare_loop,
    ),
)
FUSED_STEPS = Contestant(
    "perilune_fused",
    "native",
    "the steps compiled as one function (--flavour fused)",
    "sequential",
    partial(prepare_loop, flavour=FUSED),
    exact=True,
)
