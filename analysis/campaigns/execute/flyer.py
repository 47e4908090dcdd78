"""Simulation of a plan's trials in one worker, with one reused simulation for each variant."""

from __future__ import annotations

import time
import warnings
from collections.abc import Mapping
from typing import NamedTuple

from ...runtime.flight.base_simulation import BaseSimulation
from ...runtime.flight.group import FlightGroup
from ...runtime.flight.interruptible import StuckError, fly, make_empty_flight, run
from ...runtime.flight.results import CRASHED, LOST, NONFINITE, Flight, FlightResult
from ...runtime.instances.fmu_library import LOADING
from ...runtime.instances.instance import Log
from ...runtime.process.opening import may_load_here, open_simulation
from ...runtime.ssp.parameter_values import ParameterValue
from ...runtime.system.prepared import PreparedSystem
from ..definition.checks import VariantNames, variant_names
from ..definition.plan import BatchPlan, TrialSamples
from ..trials import TrialTable
from .evaluation import MetricEvaluator
from .fusing import Fusing

DRAWS_PER_READ = 4096  # number of trials whose draws are read together


class TrialResult(NamedTuple):
    """Result of one trial."""

    status: str
    message: str
    success: bool
    end_time: float
    metrics: dict[str, float]


class Flyer:
    """Simulations of a plan's variants, for one worker. Not shared between threads.

    With ``in_child`` all simulations run in children, even those that could run in this process. ``trials`` and
    ``workers`` are as in `Fusing`.
    """

    def __init__(self, plan: BatchPlan, *, in_child: bool = False, trials: int | None = None, workers: int = 1) -> None:
        self.plan = plan
        self._in_child = in_child
        self._drawn: TrialSamples | None = None
        self.variants = {variant.name: variant for variant in plan.campaign.variants()}
        self._ready: dict[str, tuple[BaseSimulation, VariantNames]] = {}
        self._logs: dict[str, Log] = {}
        self._warned: set[str] = set()  # variants
        self._fusing = Fusing(plan.options.chosen["flavour"], trials, workers)
        self.halted = False

    def simulation(self, variant: str) -> tuple[BaseSimulation, VariantNames]:
        """Return the simulation of a variant; open it at first use."""
        if variant not in self._ready:
            with LOADING:
                prepared = self.plan.prepare(self.variants[variant])
                if prepared.is_alone and not self._in_child and may_load_here(prepared):
                    self.close()  # another variant may have the only instance that the process can have
                names = variant_names(self.plan, prepared)
                everything = self.plan.campaign.record.traces != "none"
                requested = None if everything else {*names.signals, *names.statuses}
                faults = self.plan.list_faults()
                log = self._log_of(variant)
                simulation = open_simulation(
                    prepared,
                    in_child=self._in_child,
                    varied=names.varied,
                    requested=requested,
                    additional=names.signals,  # signals may be states of FMUs, which are not exchanged
                    faults=faults,
                    log=log,
                )
                self._ready[variant] = simulation, names
        return self._ready[variant]

    def _log_of(self, variant: str) -> Log | None:
        """Return the log for a variant's FMUs, or None if there is no log level."""
        if self.plan.watch.log is None:
            return None
        self._logs[variant] = Log(self.plan.watch.log)
        self._logs[variant].place = f"{variant}: "
        return self._logs[variant]

    def values_for(self, trial: int) -> TrialSamples:
        """Return the samples of the block of trials that contains ``trial``."""
        if self._drawn is None or trial not in self._drawn.numbers:
            first = trial - trial % DRAWS_PER_READ
            self._drawn = self.plan.values_of(range(first, min(first + DRAWS_PER_READ, self.plan.campaign.trials)))
        return self._drawn

    def fly_others(self, variant: str, plan: BatchPlan) -> TrialTable:
        """Simulate all trials of another plan for the same system. Raises KeyboardInterrupt after an `interrupt`."""
        trials = range(plan.campaign.trials)
        self._drawn = plan.values_of(trials)
        try:
            return self.fly(variant, trials)
        finally:
            self._drawn = None

    def interrupt(self) -> None:
        """End the simulation running in another thread at its next communication point."""
        self.halted = True
        for simulation, _ in list(self._ready.values()):
            simulation.interrupt()

    def abort(self) -> None:
        """End a simulation in another thread that does not reach a communication point, if possible."""
        for simulation, _ in list(self._ready.values()):
            simulation.abort("was interrupted")

    def fly(self, variant: str, trials: range) -> TrialTable:
        """Simulate trials of a variant, in order. Raises KeyboardInterrupt after an `interrupt`."""
        simulation, names = self.simulation(variant)
        evaluator = MetricEvaluator(self.plan.campaign, names)
        size = simulation.group_size if self.plan.watch.timeout is None else 0
        flown = trials.start
        while flown < trials.stop:
            sampled = self.values_for(flown)
            if size:
                following = range(flown, min(flown + size, trials.stop, sampled.numbers.stop))
                table = sampled.flights(simulation.prepared, following)
                begun = time.perf_counter()
                group = simulation.fly_group(table)
                seconds = time.perf_counter() - begun
                self._fusing.consider(variant, simulation, len(group.statuses), seconds)
            else:
                group = self._fly_next(variant, flown, trials)
            numbers = range(flown, flown + len(group.statuses))
            evaluator.add(group, numbers, sampled)
            if self.halted:
                raise KeyboardInterrupt
            flown = numbers.stop
        return evaluator.trials()

    def _fly_next(self, variant: str, trial: int, trials: range) -> FlightGroup:
        """Simulate one of ``trials``, and announce the next one."""
        if trial == trials.start:
            self._announce(variant, trial)
        if trial + 1 in trials:
            self._announce(variant, trial + 1)
        return FlightGroup.of(self._flight(variant, trial))

    def fly_one(self, variant: str, trial: int, overlay: Mapping[str, ParameterValue] | None = None) -> TrialResult:
        """Simulate one trial; the result does not depend on earlier simulations.

        ``overlay`` sets all overlaid parameters of the plan; without it they keep their values from the variant's last
        simulation.
        """
        return self._look_at(self._flight(variant, trial, overlay), trial, self.simulation(variant)[1])

    def replay(self, variant: str, trial: int) -> tuple[FlightResult, TrialResult]:
        """Simulate one trial with every signal recorded, with the same bits as in the batch.

        If an output that is not read in the batch is not finite, only signals that the batch reads are recorded.
        """
        prepared = self.plan.prepare(self.variants[variant])
        names = variant_names(self.plan, prepared)
        result = self._fly_recorded(variant, prepared, trial, names, None)
        if result.status == NONFINITE and self.plan.campaign.record.traces == "none":
            read = self._fly_recorded(variant, prepared, trial, names, {*names.signals, *names.statuses})
            if read.status != NONFINITE:
                self._warn_once(
                    variant,
                    f"trial {trial}: {result.message}; this signal is not recorded, since the campaign does not use it",
                )
                result = read
        return result, self._look_at(result, trial, names)

    def _fly_recorded(
        self, variant: str, prepared: PreparedSystem, trial: int, names: VariantNames, requested: set[str] | None
    ) -> FlightResult:
        """Simulate a trial and record these signals, or all signals for None."""
        faults, log, sampled = self.plan.list_faults(), self._log_of(variant), self.values_for(trial)
        with open_simulation(
            prepared,
            in_child=self._in_child,
            varied=names.varied,
            requested=requested,
            additional=names.signals,
            faults=faults,
            log=log,
        ) as simulation:
            simulation.set_faults(sampled.faults_of(trial))
            simulation.set(sampled.parameters(prepared, trial))
            return fly(simulation, self.plan.watch.timeout)

    def _look_at(self, flight: Flight, trial: int, names: VariantNames) -> TrialResult:
        evaluator = MetricEvaluator(self.plan.campaign, names)
        evaluator.add(FlightGroup.of(flight), range(trial, trial + 1), self.values_for(trial))
        return result_of(evaluator.trials(), 0)

    def _flight(self, variant: str, trial: int, overlay: Mapping[str, ParameterValue] | None = None) -> Flight:
        simulation, _ = self.simulation(variant)
        if variant in self._logs:
            self._logs[variant].place = f"{variant}: trial {trial}: "
        sampled = self.values_for(trial)
        simulation.set_faults(sampled.faults_of(trial))
        parameters = {**sampled.parameters(simulation.prepared, trial), **(overlay or {})}
        try:
            flight = run(simulation, parameters, self.plan.watch.timeout)
            if self._is_to_be_repeated(simulation, flight):
                first, flight = flight.message, run(simulation, parameters, self.plan.watch.timeout)
                if flight.status not in LOST:
                    self._warn_once(
                        variant,
                        f"trial {trial}: {first}; the failure did not recur in a new process, and its result is used",
                    )
            return flight
        except StuckError as error:  # its instances are lost; the next trial uses new ones
            del self._ready[variant]
            return make_empty_flight(simulation, str(error))

    def _warn_once(self, variant: str, text: str) -> None:
        """Warn of problems in a trial of a variant, but only for the first such trial."""
        if variant not in self._warned:
            self._warned.add(variant)
            warnings.warn(f"{variant}: {text}", stacklevel=2)

    def _announce(self, variant: str, trial: int) -> None:
        if variant in self._ready and not self.halted:
            simulation, _ = self._ready[variant]
            sampled = self.values_for(trial)
            simulation.queue_run(sampled.parameters(simulation.prepared, trial), sampled.faults_of(trial))

    def _is_to_be_repeated(self, simulation: BaseSimulation, flight: Flight) -> bool:
        """Return True if a simulation whose process ended is to be repeated in a new process.

        Its FMU may not be the cause: an earlier simulation may have corrupted the process, or another program may have
        killed it.
        """
        is_lost = flight.status in LOST and not self.halted
        return is_lost and (flight.status == CRASHED or simulation.flights > 1)

    def close(self) -> None:
        for simulation, _ in self._ready.values():
            simulation.close()
        self._ready = {}


def result_of(trials: TrialTable, row: int) -> TrialResult:
    """Return the result of a trial, from its row in a table in memory."""
    entries = trials.table.slice(row, 1).to_pylist()[0]
    return TrialResult(
        status=entries["status"],
        message=entries["message"],
        success=bool(entries["success"]),
        end_time=float(entries["end_time"]),
        metrics={
            name.removeprefix("metric."): float(value) for name, value in entries.items() if name.startswith("metric.")
        },
    )
