"""FMPy's FMU interface in a loop of one's own: what a careful user writes by hand."""

from __future__ import annotations

from dataclasses import dataclass

from fmpy.fmi2 import FMU2Slave

from ..runtime.system.fmu import Fmu
from .contestant import Fly, Values
from .course import Course


@dataclass
class _Unit:
    """An FMU with its lists made once: value references and places in the common list of values."""

    slave: FMU2Slave
    inputs: list[int]
    sources: list[int]
    outputs: list[int]
    first: int  # outputs lie together in the list of values
    parameters: dict[str, dict[int, float | int | bool | str]]  # by type and value reference

    def set_inputs(self, values: list[float]) -> None:
        self.slave.setReal(self.inputs, [values[source] for source in self.sources])

    def get_outputs(self, values: list[float]) -> None:
        values[self.first : self.first + len(self.outputs)] = self.slave.getReal(self.outputs)


def prepare(course: Course) -> Fly:
    """One setReal, doStep and getReal per FMU and step, in the order of our sequential algorithm."""
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


def _unit(course: Course, component: str, fmu: Fmu, places: dict[str, int]) -> _Unit:
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
            parameters[kind][variable.valueReference] = value
    return _Unit(
        slave=slave,
        inputs=[fmu.variables[link.target.variable].valueReference for link in links],
        sources=[places[link.source.name] for link in links],
        outputs=[fmu.variables[name.removeprefix(f"{component}.")].valueReference for name in mine],
        first=min(mine.values(), default=0),
        parameters=parameters,
    )
