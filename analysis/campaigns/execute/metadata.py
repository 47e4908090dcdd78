"""Metadata of a stored batch: inputs that determine its numbers; units, types and expressions of its columns."""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib.metadata import version

from ...runtime.system.arrays.axis_names import names_of_axes
from ...runtime.system.prepared import PreparedSystem
from ..definition.campaign import Metric
from ..definition.plan import BatchPlan
from ..folder.provenance import CampaignMetadata, CampaignProvenance, MetricMetadata, SignalMetadata

TARGET = re.compile(r"(.+\.)?target_(position|velocity)\[[123]\]")


def provenance(plan: BatchPlan, systems: Mapping[str, PreparedSystem]) -> CampaignProvenance:
    """Return the inputs that determine a batch's numbers; ``systems`` are the prepared systems by variant."""
    first = next(iter(systems.values()))
    options = plan.options
    metadata: CampaignProvenance = {
        "system": first.archive.name,
        "system_sha256": first.archive.digest,
        "campaign": plan.campaign.file,
        "campaign_sha256": plan.campaign_sha256,
        "parameter_sets": [*plan.campaign.parameters, *options.parameters],
        "set": {**plan.campaign.settings, **options.set},
        "variant": options.chosen["variant"],
        "start_time": first.start,
        "steps": first.steps,
        "trials": plan.campaign.trials,
        "seed": plan.campaign.seed,
        "step": first.step,
        "algorithm": first.algorithm,
    }
    if options.chosen["feedthrough"]:
        metadata["feedthrough"] = list(options.chosen["feedthrough"])
    if options.chosen["no_feedthrough"]:
        metadata["no_feedthrough"] = list(options.chosen["no_feedthrough"])
    assumptions = list(dict.fromkeys(note for prepared in systems.values() for note in prepared.assumptions))
    if assumptions:
        metadata["assumptions"] = assumptions
    if first.drive is not None:
        metadata["input"] = first.drive.facts()["input"]
    if plan.watch.timeout is not None:
        metadata["timeout"] = plan.watch.timeout
    metadata["fmus"] = {
        variant: {name: fmu.digest for name, fmu in prepared.network.fmus.items()}
        for variant, prepared in systems.items()
    }
    metadata["perilune"] = version("perilune")
    metadata.update(campaign_metadata(plan, systems))
    return metadata


def campaign_metadata(plan: BatchPlan, systems: Mapping[str, PreparedSystem]) -> CampaignMetadata:
    """See `CampaignMetadata`."""
    campaign, record = plan.campaign, plan.campaign.record
    signals = _signals(systems)
    metadata: CampaignMetadata = {}
    if campaign.group:
        metadata["group"] = campaign.group
    if faults := plan.fault_texts():
        metadata["faults"] = faults
    if campaign.sweeps:
        metadata["sweep"] = dict(campaign.sweeps)
    if plan.supplied is not None and plan.supplied.sha256:
        metadata["draws_sha256"] = plan.supplied.sha256
    if plan.is_counted:
        metadata["draw_scheme"] = campaign.draw_scheme
    metadata["description"] = campaign.description
    metadata["success"] = campaign.success.text
    metadata["metrics"] = {metric.name: _metric(metric, signals) for metric in campaign.metrics}
    metadata["record"] = {
        "every": record.every,
        "signals": list(record.signals),
        "trials": record.trials,
        "traces": record.traces,
    }
    metadata["signals"] = {
        name: fact
        for name, fact in signals.items()
        if record.traces != "none" or name in record.final or name in record.signals
    }
    metadata["targets"] = {variant: _targets(prepared) for variant, prepared in systems.items()}
    return metadata


def _metric(metric: Metric, signals: Mapping[str, SignalMetadata]) -> MetricMetadata:
    expression = metric.expression
    truth = expression.is_truth or (expression.text in signals and signals[expression.text]["type"] == "Boolean")
    metadata: MetricMetadata = {
        "expression": expression.text,
        "reduction": metric.reduction,
        "unit": metric.unit,
        "description": metric.description,
        "truth": truth and metric.reduction in ("final", "min", "max", "first"),
    }
    if axis := signals.get(expression.text, {}).get("axis"):
        metadata["axis"] = axis
    if metric.condition is None:
        return metadata
    return {"condition": metric.condition.text, "delay": metric.delay, **metadata}


def _signals(systems: Mapping[str, PreparedSystem]) -> dict[str, SignalMetadata]:
    """Return unit, type and axis of every signal of any variant, by name."""
    signals: dict[str, SignalMetadata] = {}
    for prepared in systems.values():
        network = prepared.network
        for component, fmu in network.fmus.items():
            for variable in fmu.variables.values():
                if variable.causality in ("input", "output"):
                    fact = SignalMetadata(unit=variable.unit, type=variable.type)
                    signals.setdefault(f"{component}.{variable.name}", fact)
        for node in network.nodes.values():
            if node.component is None and node.kind not in ("parameter", "calculatedParameter"):
                fact = SignalMetadata(unit=node.unit.name if node.unit else None, type=node.type_name or "Real")
                signals.setdefault(node.name, fact)
        for name, axis in names_of_axes(network, signals).items():
            signals[name].setdefault("axis", axis)
    return signals


def _targets(prepared: PreparedSystem) -> dict[str, float]:
    """Return the initial values of parameters named target_position and target_velocity, in one variant."""
    targets = {}
    for component, fmu in prepared.network.fmus.items():
        for variable in fmu.variables.values():
            name = f"{component}.{variable.name}"
            if variable.causality == "parameter" and TARGET.fullmatch(name):
                value = prepared.settings.variables.get((component, variable.name), variable.start_text)
                targets[name] = float(value)
    return targets
