"""Campaign: variants, draws, metrics, records, success and requirements. See docs/campaigns.md."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ....common.bounds import TRIALS
from ....common.errors import InputError, suggestion
from ...runtime.system.assignments import SINGLE
from ...runtime.system.options import Layer
from ..draws.interfaces import Draw, input_names
from ..draws.lookup import Lookup
from .expressions import Expression
from .faults import CampaignFault
from .requirements import Requirement

TRACES = ("none", "failures", "all")

Setting = float | int | bool | str | Sequence[float | int]


@dataclass(frozen=True)
class Metric:
    """A number for each trial: an expression over the record, reduced over the rows of a window.

    The reduction last_outside uses ``band`` (low, high); the reduction first uses ``condition`` and ``delay`` (s).
    ``window`` (t0, t1) is in s and includes both ends; None means the entire simulation. ``unit`` labels the value.
    """

    name: str
    expression: Expression
    reduction: str
    band: tuple[float, float] | None = None
    window: tuple[float, float] | None = None
    unit: str = "1"
    description: str = ""
    condition: Expression | None = None
    delay: float = 0.0

    @property
    def names(self) -> frozenset[str]:
        """Names used in the metric's expressions."""
        return self.expression.names | (self.condition.names if self.condition is not None else frozenset())


@dataclass(frozen=True)
class TrialRecord:
    """Stored values of a trial besides its metrics: final values, every n-th row of signals, complete traces.

    Sampled signals are only stored for the first ``trials`` trials.
    """

    final: tuple[str, ...] = ()
    every: int | None = None
    signals: tuple[str, ...] = ()
    traces: str = "none"
    trials: int | None = None


@dataclass(frozen=True)
class Scatter:
    """Scatter plot on a batch's page: the metric ``y`` of every trial over the metric ``x``.

    ``circle`` is the radius of a circle around the origin, in the unit of both metrics, or None.
    """

    name: str
    x: str
    y: str
    circle: float | None = None
    title: str = ""


SCHEMES = ("table", "counter")  # one table of all trials, or counter-based values for each block of trials


@dataclass(frozen=True)
class Variant:
    """Variant of the system: a configuration, or a combination of compared FMUs.

    ``use`` maps components to FMUs, ``parameters`` lists parameter sets, and ``settings`` maps ``component.variable``
    to values. They override the campaign's.
    """

    name: str
    use: Mapping[str, str] = field(default_factory=dict)
    parameters: tuple[str, ...] = ()
    settings: Mapping[str, Setting] = field(default_factory=dict)


@dataclass(frozen=True)
class Campaign:
    """Campaign as declared. Raises InputError for invalid numbers of trials or seeds, also after `replace`.

    ``metrics``, ``draws`` and ``derived`` are in the order of the file; ``derived`` are expressions over draws and
    earlier derived values. These attributes contain tables of the file: ``settings`` [set], ``compare`` [compare],
    ``configurations`` [configuration.NAME], ``faults`` [fault], ``scatters`` [scatter], ``requirements`` [requirement]
    and ``lookups`` [lookup]. ``selected`` names the only configuration to simulate, if set. ``group`` is the drawn or
    derived value by which [group] groups trials. ``draw_scheme`` is one of `SCHEMES`. ``file`` is named in errors.
    ``sweeps`` are the draws added by the command line, as texts by name (sweeps.py).
    """

    file: str
    system: str
    trials: int
    seed: int
    success: Expression
    metrics: tuple[Metric, ...] = ()
    draws: tuple[Draw, ...] = ()
    derived: Mapping[str, Expression] = field(default_factory=dict)
    settings: Mapping[str, Setting] = field(default_factory=dict)
    compare: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    configurations: tuple[Variant, ...] = ()
    selected: str | None = None
    parameters: tuple[str, ...] = ()
    record: TrialRecord = TrialRecord()
    description: str = ""
    group: str | None = None
    faults: tuple[CampaignFault, ...] = ()
    scatters: tuple[Scatter, ...] = ()
    requirements: tuple[Requirement, ...] = ()
    draw_scheme: str = "table"
    sweeps: Mapping[str, str] = field(default_factory=dict)
    lookups: tuple[Lookup, ...] = ()

    def judged_expressions(self) -> list[Expression]:
        """Return the expressions of success and of the requirements."""
        return [self.success, *(requirement.expression for requirement in self.requirements)]

    def judged_names(self) -> set[str]:
        """Return the names used in success and requirements."""
        bounds = {requirement.metric for requirement in self.requirements if requirement.metric is not None}
        return bounds.union(*(expression.names for expression in self.judged_expressions()))

    def __post_init__(self) -> None:
        if self.trials < 1:
            raise InputError(self.file, "trials", f"{self.trials} trial(s)", "give 1 or more")
        TRIALS.check(self.trials, self.file, "trials")
        for slot, fmus in self.compare.items():
            if not fmus or len(set(fmus)) != len(fmus) or "" in fmus:
                raise InputError(
                    self.file,
                    f"compare {slot}",
                    f"{', '.join(fmus)}: a name is empty or repeated",
                    "name each FMU once",
                )
        if self.seed < 0:
            raise InputError(self.file, "seed", f"{self.seed} is negative", "give a seed >= 0")

    def layer_of(self, variant: Variant) -> Layer:
        """Return the FMUs, parameter sets and values of a variant, including those that all variants have in common."""
        settings = {**self.settings, **variant.settings}
        places = dict.fromkeys(settings, (self.file, 0))
        return Layer(use=variant.use, parameters=self.parameters + variant.parameters, set=settings, places=places)

    def input_names(self) -> list[str]:
        """Return the names of all drawn and derived values, and of lookups."""
        return input_names(self) + list(self.derived) + [lookup.name for lookup in self.lookups]

    def metrics_of_lookups(self) -> list[str]:
        """Return the names of the metrics that use a lookup."""
        looked_up = {lookup.name for lookup in self.lookups}
        return [metric.name for metric in self.metrics if metric.names & looked_up]

    def without_lookups(self) -> Campaign:
        """Return the campaign without lookups and metrics that use them, for trials other than the campaign's own.

        Raises InputError if success or a requirement needs one of these metrics.
        """
        dropped = set(self.metrics_of_lookups())
        asking = {
            "success": self.success,
            **{f"requirement.{each.name}": each.expression for each in self.requirements},
        }
        for element, formula in asking.items():
            for name in sorted(formula.names & dropped):
                problem = f"{name} comes from a lookup table, which covers only the campaign's own trials"
                raise InputError(self.file, element, problem, "use a campaign without [lookup] for other trials")
        return replace(
            self,
            lookups=(),
            metrics=tuple(metric for metric in self.metrics if metric.name not in dropped),
            scatters=tuple(each for each in self.scatters if not {each.x, each.y} & dropped),
        )

    def place_of(self, drawn: str) -> str:
        """Return the origin of a drawn value for error messages: the file, or the option with the sweep."""
        return SINGLE if drawn in self.sweeps else self.file

    def variants(self) -> list[Variant]:
        """Return the configurations, or all combinations of the compared FMUs, or a single variant named ``default``.

        If a variant is ``selected``, only this variant is returned.
        """
        return [each for each in self._list_variants() if self.selected in (None, each.name)]

    def _list_variants(self) -> list[Variant]:
        if self.configurations:
            return list(self.configurations)
        if not self.compare:
            return [Variant("default")]
        combinations = itertools.product(*self.compare.values())
        return [Variant("__".join(fmus), dict(zip(self.compare, fmus, strict=True))) for fmus in combinations]

    def select(self, configuration: str) -> Campaign:
        """Return the campaign with only one of its variants. Raises InputError."""
        names = [each.name for each in self._list_variants()]
        if configuration not in names:
            element = f"`configuration` {configuration}"
            raise InputError(self.file, element, "no such configuration", suggestion(configuration, names))
        return replace(self, selected=configuration)


MAXIMUM_GROUPS = 100  # groups of a campaign


@dataclass(frozen=True)
class TrialGroup:
    """Trials that share a ``value``; ``label`` is the value as text, unique among the groups."""

    label: str
    value: float

    def has(self, values: np.ndarray) -> np.ndarray:
        """Return True for each trial in the group; ``values`` (trials,) are the values by which trials are grouped."""
        return values == self.value


def groups_of(parts: Iterable[np.ndarray], where: tuple[str, str]) -> list[TrialGroup]:
    """Return the groups of trials with equal finite values, in ascending order; values are passed in blocks (trials,).

    ``where`` (file, element) is named in errors. Raises InputError for more than `MAXIMUM_GROUPS` groups.
    """
    distinct = np.empty(0)
    for values in parts:
        distinct = np.union1d(distinct, values)
        if distinct.size > MAXIMUM_GROUPS:
            problem = f"has at least {distinct.size} different values, and each would form a group"
            raise InputError(*where, problem, f"group by a quantity with at most {MAXIMUM_GROUPS} values")
    plain = [float(value) + 0.0 for value in distinct]  # no -0
    labels = [f"{value:.10g}" for value in plain]
    if len(set(labels)) < len(labels):
        labels = [repr(value) for value in plain]
    return [TrialGroup(label, value) for label, value in zip(labels, plain, strict=True)]
