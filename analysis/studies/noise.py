"""Noise that components generate: random in a study, or the same as in one trial for all simulations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...common.errors import InputError
from ..campaigns.definition.plan import with_streams
from ..campaigns.draws.interfaces import Columns
from ..campaigns.draws.supplied import ALL, Streams, SuppliedDraws
from ..runtime.system.prepared import PreparedSystem


@dataclass(frozen=True)
class Noise:
    """Noise of ``components``: random if ``trial`` is None, otherwise the noise of this trial of the campaign."""

    components: tuple[str, ...]
    trial: int | None
    seed: int

    @property
    def sources(self) -> tuple[str, ...]:
        """Components whose noise is random in the study."""
        return self.components if self.trial is None else ()

    @property
    def is_held(self) -> bool:
        """True if there is noise, and all simulations have the noise of one trial."""
        return self.trial is not None and bool(self.components)

    def of(self, streams: np.ndarray) -> Streams:
        """Return random streams by component from trial numbers (flights, sources)."""
        return dict(zip(self.sources, streams.T, strict=True))

    def same(self, streams: np.ndarray) -> Streams:
        """Return random streams by component, the same of ``trials`` (flights,) for all sources of a simulation."""
        return dict.fromkeys(self.sources, streams)

    def document(self) -> dict[str, object]:
        """Return the entry of JSON results; ``noise_trial`` is None for random noise, and without noise."""
        return {
            "noise_trial": self.trial if self.components else None,
            "noise": {"components": list(self.components), "random": bool(self.sources)},
        }


def noise_of(prepared: PreparedSystem, trial: int | None, seed: int) -> Noise:
    """Return the noise of a system in a study. Raises InputError for a missing trial."""
    if trial is not None and trial < 0:
        raise InputError("`noise_trial`", str(trial), "no such trial", "give 0 or more")
    return Noise(tuple(with_streams(prepared)), trial, seed)


def make_samples(columns: Columns, streams: Streams, noise: Noise) -> SuppliedDraws:
    """Return draws with random streams: of all sources if the noise is random, otherwise of one trial."""
    if noise.sources:
        return SuppliedDraws(columns, streams)
    return SuppliedDraws(columns, {ALL: np.full(len(next(iter(columns.values()))), noise.trial or 0)})


def conditions(noise: Noise, held: Mapping[str, float]) -> str:
    """Return the conditions under which a result holds, as the end of a line; "" if there are none."""
    texts = [f"{name} = {value:g}" for name, value in held.items()]
    texts += [f"the noise realisation of trial {noise.trial}"] if noise.is_held else []
    return f", conditional on {' and '.join(texts)}" if texts else ""
