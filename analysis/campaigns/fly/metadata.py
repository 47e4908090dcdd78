"""What a stored batch states of itself: what its numbers depend on, and units, types, expressions of its columns."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from importlib.metadata import version
from typing import Any

from ...runtime.system.prepared import PreparedSystem
from ..spec.campaign import Metric
from ..spec.plan import BatchPlan

TARGET = re.compile(r"(.+\.)?target_(position|velocity)\[[123]\]")


def provenance(plan: BatchPlan, systems: Mapping[str, PreparedSystem]) -> dict[str, Any]:
    """What a batch's numbers depend on, apart from the trials themselves."""
    first = next(iter(systems.values()))
    options = plan.options
    assumptions = list(dict.fromkeys(note for prepared in systems.values() for note in prepared.assumptions))
    return {
        "system": first.archive.name,
        "system_sha256": first.archive.digest,
        "campaign": plan.campaign.file,
        "campaign_sha256": plan.campaign_sha256,
        "parameter_sets": [*plan.campaign.parameters, *plan.options.parameters],
        "set": {**plan.campaign.settings, **plan.options.set},
        "variant": plan.options.variant,
        "start_time": first.start,
        "steps": first.steps,
        "trials": plan.campaign.trials,
        "seed": plan.campaign.seed,
        "step": first.step,
        "algorithm": first.algorithm,
        **({"feedthrough": list(options.feedthrough)} if options.feedthrough else {}),
        **({"no_feedthrough": list(options.no_feedthrough)} if options.no_feedthrough else {}),
        **({"assumptions": assumptions} if assumptions else {}),
        **(first.drive.facts() if first.drive is not None else {}),
        **({"timeout": plan.watch.timeout} if plan.watch.timeout is not None else {}),
        "fmus": {
            variant: {name: fmu.digest for name, fmu in prepared.network.fmus.items()}
            for variant, prepared in systems.items()
        },
        "perilune": version("perilune"),
        **campaign_metadata(plan, systems),
    }


def batch_digest(provenance: Mapping[str, Any]) -> str:
    """The SHA-256 that identifies a batch: of its provenance as JSON with sorted keys.

    It is the same for any number of trials, since a batch can be resumed with more.
    """
    return hashlib.sha256(json.dumps({**provenance, "trials": None}, sort_keys=True).encode()).hexdigest()


def campaign_metadata(plan: BatchPlan, systems: Mapping[str, PreparedSystem]) -> dict[str, Any]:
    """Properties of a batch that its numbers do not show; ``systems`` are the prepared ones by variant.

    ``group``, ``faults``, ``sweep``, ``draws_sha256`` of given draws and a ``draw_scheme`` that is no table (each where
    there is any), ``description``, ``success`` (expression), ``metrics`` (expression, reduction, unit, description,
    whether the value is true or false, and what else its reduction has), ``record`` (every, signals, trials, traces),
    ``signals`` (unit and FMI type of what is recorded), ``targets`` (parameters target_position and target_velocity by
    variant).
    """
    campaign = plan.campaign
    signals = _signals(systems)
    given = "" if plan.given is None else plan.given.sha256
    optional = {
        "group": campaign.group,
        "faults": plan.fault_texts(),
        "sweep": dict(campaign.sweeps),
        "draws_sha256": given,
        "draw_scheme": campaign.draw_scheme if plan.is_counted else "",
    }
    return {name: fact for name, fact in optional.items() if fact} | {
        "description": campaign.description,
        "success": campaign.success.text,
        "metrics": {metric.name: _metric(metric, signals) for metric in campaign.metrics},
        "record": {
            "every": campaign.record.every,
            "signals": list(campaign.record.signals),
            "trials": campaign.record.trials,
            "traces": campaign.record.traces,
        },
        "signals": {name: fact for name, fact in signals.items() if _is_kept(plan, name)},
        "targets": {variant: _targets(prepared) for variant, prepared in systems.items()},
    }


def _metric(metric: Metric, signals: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    expression = metric.expression
    truth = expression.is_truth or signals.get(expression.text, {}).get("type") == "Boolean"
    condition = {} if metric.condition is None else {"condition": metric.condition.text, "delay": metric.delay}
    return condition | {
        "expression": expression.text,
        "reduction": metric.reduction,
        "unit": metric.unit,
        "description": metric.description,
        "truth": truth and metric.reduction in ("final", "min", "max", "first"),
    }


def _is_kept(plan: BatchPlan, name: str) -> bool:
    record = plan.campaign.record
    return record.traces != "none" or name in record.final or name in record.signals


def _signals(systems: Mapping[str, PreparedSystem]) -> dict[str, dict[str, Any]]:
    """Unit and type of every signal of any variant by name; None for a unit that is not declared."""
    signals: dict[str, dict[str, Any]] = {}
    for prepared in systems.values():
        network = prepared.network
        for component, fmu in network.fmus.items():
            for variable in fmu.variables.values():
                if variable.causality in ("input", "output"):
                    fact = {"unit": fmu.unit_of(variable), "type": variable.type}
                    signals.setdefault(f"{component}.{variable.name}", fact)
        for node in network.nodes.values():
            if node.component is None and node.kind not in ("parameter", "calculatedParameter"):
                fact = {"unit": node.unit.name if node.unit else None, "type": node.type_name or "Real"}
                signals.setdefault(node.name, fact)
    return signals


def _targets(prepared: PreparedSystem) -> dict[str, float]:
    """Parameters called target_position and target_velocity, as one variant's flights begin with them."""
    targets = {}
    for component, fmu in prepared.network.fmus.items():
        for variable in fmu.variables.values():
            name = f"{component}.{variable.name}"
            if variable.causality == "parameter" and TARGET.fullmatch(name):
                value = prepared.settings.variables.get((component, variable.name), variable.start)
                targets[name] = float(value)
    return targets
