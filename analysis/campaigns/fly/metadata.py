"""What a stored batch says of its own columns: units, types, expressions, targets. For readers of its files."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from ...runtime.system.prepared import PreparedSystem
from ..spec.campaign import Metric
from ..spec.plan import BatchPlan

TARGET = re.compile(r"(.+\.)?target_(position|velocity)\[[123]\]")


def campaign_facts(plan: BatchPlan, systems: Mapping[str, PreparedSystem]) -> dict[str, Any]:
    """Facts of a batch that its numbers do not show; ``systems`` are the prepared ones by variant.

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
    found: dict[str, dict[str, Any]] = {}
    for prepared in systems.values():
        network = prepared.network
        for component, fmu in network.fmus.items():
            for variable in fmu.variables.values():
                if variable.causality in ("input", "output"):
                    fact = {"unit": fmu.unit_of(variable), "type": variable.type}
                    found.setdefault(f"{component}.{variable.name}", fact)
        for node in network.nodes.values():
            if node.component is None and node.kind not in ("parameter", "calculatedParameter"):
                fact = {"unit": node.unit.name if node.unit else None, "type": node.type_name or "Real"}
                found.setdefault(node.name, fact)
    return found


def _targets(prepared: PreparedSystem) -> dict[str, float]:
    """Parameters called target_position and target_velocity, as one variant's flights begin with them."""
    found = {}
    for component, fmu in prepared.network.fmus.items():
        for variable in fmu.variables.values():
            name = f"{component}.{variable.name}"
            if variable.causality == "parameter" and TARGET.fullmatch(name):
                value = prepared.settings.variables.get((component, variable.name), variable.start)
                found[name] = float(value)
    return found
