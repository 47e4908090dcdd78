"""Recorded simulations of a comparison, read once for paths and quantities over time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .....campaigns.compare.campaign_comparison import CampaignComparison
from ...campaign.recorded_names import names_of_record
from .bands import Bands, bands_of
from .recorded import ComparedFlight, FlightQuantity, quantities, read_flights, trials_with_traces
from .trajectories import VariantPaths, collect_paths


@dataclass(frozen=True)
class History:
    """A quantity over time with its percentiles by variant; ``constant`` is its value if it never changes."""

    quantity: FlightQuantity
    bands: Mapping[str, Bands]
    name: str
    constant: float | None


@dataclass(frozen=True)
class FlightHistories:
    """Recorded simulations by variant, with their paths and quantities."""

    comparison: CampaignComparison

    @cached_property
    def by_label(self) -> dict[str, list[ComparedFlight]]:
        """The displayed simulations by variant."""
        trials = trials_with_traces(self.comparison.contenders.values())
        return {
            label: read_flights(contender, trials[label], names_of_record(contender.stored.document))
            for label, contender in self.comparison.contenders.items()
        }

    @cached_property
    def bundles(self) -> dict[str, VariantPaths]:
        """The paths of the variants that have positions."""
        bundles = {
            label: collect_paths(self.comparison.contenders[label], flights) for label, flights in self.by_label.items()
        }
        return {label: bundle for label, bundle in bundles.items() if bundle is not None}

    @cached_property
    def histories(self) -> list[History]:
        """The quantities over time that at least one variant has."""
        named = {
            quantity.label: quantity
            for batch in self.comparison.batches.values()
            for quantity in quantities(batch.document)
        }
        histories = []
        for index, quantity in enumerate(named.values()):
            bands = {label: bands_of(quantity, flights) for label, flights in self.by_label.items()}
            displayed = {label: band for label, band in bands.items() if band is not None and band.time.size}
            if displayed:
                values = np.concatenate([band.finite_values() for band in displayed.values()])
                constant = float(values[0]) if values.size and np.ptp(values) == 0.0 else None
                histories.append(History(quantity, displayed, f"history{index}", constant))
        return histories

    def of_kinds(self, *kinds: str) -> list[History]:
        """Return the quantities of these kinds, in the order of the kinds."""
        return [each for kind in kinds for each in self.histories if each.quantity.kind == kind]
