"""A campaign: what is flown, drawn, measured, recorded and called a success. See docs/campaigns.md."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ....common.bounds import TRIALS
from ....common.errors import InputError, suggestion
from ...runtime.system.assignments import SINGLE
from ...runtime.system.options import Layer
from ..draws.declared import Draw, input_names
from ..draws.lookup import Lookup
from .expressions import Expression
from .faults import CampaignFault
from .requirements import Requirement

TRACES = ("none", "failures", "all")

Setting = float | int | bool | str | Sequence[float | int]


@dataclass(frozen=True)
class Metric:
    """One number per trial: an expression over the record, reduced over the rows of a window.

    ``band`` (low, high) belongs to the reduction last_outside, ``condition`` and ``delay`` (s) to first;
    ``window`` (t0, t1) is in s, both ends included, None for the whole flight. ``unit`` labels the value.
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
        """Names that its expressions refer to."""
        return self.expression.names | (self.condition.names if self.condition is not None else frozenset())


@dataclass(frozen=True)
class TrialRecord:
    """Stored values of a trial apart from its metrics: final values, every n-th row of signals, full traces.

    ``trials`` keeps the sampled signals of that many trials, the first ones, only.
    """

    final: tuple[str, ...] = ()
    every: int | None = None
    signals: tuple[str, ...] = ()
    traces: str = "none"
    trials: int | None = None


@dataclass(frozen=True)
class Scatter:
    """A figure that the page of a batch is to have: the metric ``y`` of every trial over ``x``.

    ``circle`` is the radius around the origin that is drawn, in the unit of both; None for none.
    """

    name: str
    x: str
    y: str
    circle: float | None = None
    title: str = ""


SCHEMES = ("table", "counter")  # one table of all trials, or every trial by itself: other values


@dataclass(frozen=True)
class Variant:
    """One way to build the system: a configuration, or the FMUs of compared slots.

    ``use`` maps components to FMUs, ``parameters`` lists parameter sets, ``settings`` maps ``component.variable`` to
    values; they come after the campaign's own.
    """

    name: str
    use: Mapping[str, str] = field(default_factory=dict)
    parameters: tuple[str, ...] = ()
    settings: Mapping[str, Setting] = field(default_factory=dict)


@dataclass(frozen=True)
class Campaign:
    """A campaign as declared. Raises InputError where trials or seed make no sense, also after `replace`.

    ``metrics``, ``draws`` and ``derived`` keep the order of the file; ``derived`` are expressions over draws and
    earlier derived values. ``settings`` and ``compare`` are [set] and [compare], ``configurations``
    [configuration.NAME], of which ``selected`` is the only one that is simulated; ``group`` is the drawn or derived
    value by which [group] sums trials up, ``faults`` are [fault], ``scatters`` [scatter], ``requirements``
    [requirement], ``lookups`` [lookup], ``draw_scheme`` is one of `SCHEMES`. ``file`` is what errors name. ``sweeps``
    are the draws that the command line has added, as texts by name (sweeps.py).
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
        """Return success and the requirements' expressions."""
        return [self.success, *(requirement.expression for requirement in self.requirements)]

    def judged_names(self) -> set[str]:
        """Return the names in success and requirements."""
        bounds = {requirement.metric for requirement in self.requirements if requirement.metric is not None}
        return bounds.union(*(expression.names for expression in self.judged_expressions()))

    def __post_init__(self) -> None:
        if self.trials < 1:
            raise InputError(self.file, "trials", f"{self.trials} trial(s)", "give 1 or more")
        TRIALS.check(self.trials, self.file, "trials")
        for slot, fmus in self.compare.items():
            if not fmus or len(set(fmus)) != len(fmus) or "" in fmus:
                raise InputError(
                    self.file, f"compare {slot}", f"{', '.join(fmus)}: empty or repeated", "name each FMU once"
                )
        if self.seed < 0:
            raise InputError(self.file, "seed", f"{self.seed} is negative", "give a seed >= 0")

    def layer_of(self, variant: Variant) -> Layer:
        """Return the FMUs, parameter sets and values of a variant, over those that all variants have."""
        settings = {**self.settings, **variant.settings}
        places = dict.fromkeys(settings, (self.file, 0))
        return Layer(use=variant.use, parameters=self.parameters + variant.parameters, set=settings, places=places)

    def input_names(self) -> list[str]:
        """Return the names of all drawn and derived values, and of lookups."""
        return input_names(self) + list(self.derived) + [lookup.name for lookup in self.lookups]

    def metrics_of_lookups(self) -> list[str]:
        """Return the names of the metrics that need a lookup."""
        looked_up = {lookup.name for lookup in self.lookups}
        return [metric.name for metric in self.metrics if metric.names & looked_up]

    def without_lookups(self) -> Campaign:
        """Return the campaign for trials that are not its own: without lookups and the metrics that need them.

        Raises InputError where [success] or [requirement] needs one of these.
        """
        dropped = set(self.metrics_of_lookups())
        asking = {
            "success": self.success,
            **{f"requirement.{each.name}": each.expression for each in self.requirements},
        }
        for element, formula in asking.items():
            for name in sorted(formula.names & dropped):
                problem = f"{name} needs a lookup, whose numbers are of the campaign's own trials"
                raise InputError(self.file, element, problem, "use another campaign for trials that are not its own")
        return replace(
            self,
            lookups=(),
            metrics=tuple(metric for metric in self.metrics if metric.name not in dropped),
            scatters=tuple(each for each in self.scatters if not {each.x, each.y} & dropped),
        )

    def place_of(self, drawn: str) -> str:
        """Return the source of a drawn value, as errors name it: the file, or the option that sweeps it."""
        return SINGLE if drawn in self.sweeps else self.file

    def variants(self) -> list[Variant]:
        """Return the configurations, or every combination of the compared FMUs, named by them; else one named
        ``default``.

        Of these only the ``selected`` one, if any.
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
        """Return the campaign with one of its variants only. Raises InputError."""
        names = [each.name for each in self._list_variants()]
        if configuration not in names:
            element = f"`configuration` {configuration}"
            raise InputError(self.file, element, "no such configuration", suggestion(configuration, names))
        return replace(self, selected=configuration)


MAXIMUM_GROUPS = 100  # groups of a campaign


@dataclass(frozen=True)
class TrialGroup:
    """Trials that share one ``value``; ``label`` is that as a text, different for each."""

    label: str
    value: float

    def has(self, values: np.ndarray) -> np.ndarray:
        """Return for each trial if it is in the group, by their ``values`` (trials,)."""
        return values == self.value


def groups_of(parts: Iterable[np.ndarray], where: tuple[str, str]) -> list[TrialGroup]:
    """Return the groups of trials by their finite values, in blocks (trials,); in ascending order.

    ``where`` (file, element) is what an error points to. Raises InputError for more than `MAXIMUM_GROUPS` groups.
    """
    distinct = np.empty(0)
    for values in parts:
        distinct = np.union1d(distinct, values)
        if distinct.size > MAXIMUM_GROUPS:
            problem = f"{distinct.size} different values or more, a group each"
            raise InputError(
                *where, problem, f"group by a value with {MAXIMUM_GROUPS} at most, as a choice or a grid has"
            )
    plain = [float(value) + 0.0 for value in distinct]  # no -0
    labels = [f"{value:.10g}" for value in plain]
    if len(set(labels)) < len(labels):
        labels = [repr(value) for value in plain]
    return [TrialGroup(label, value) for label, value in zip(labels, plain, strict=True)]
