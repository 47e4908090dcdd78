"""Page of the demonstration: a landing, and three guidance laws compared with their authors' publications."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from perilune.analysis.campaigns.execute.campaign_result import CampaignResult
from perilune.analysis.documents.common.page import write_page
from perilune.analysis.documents.common.panels import swatch
from perilune.analysis.documents.of.batch.content import BatchContent
from perilune.analysis.documents.of.batch.distribution_sections import distribution_figures
from perilune.analysis.documents.of.batch.embedded_trials import trials_document
from perilune.analysis.documents.of.batch.scatters import failure_figures, outcome_marks
from perilune.analysis.documents.of.campaign.distributions import rates_figure
from perilune.analysis.documents.render.cell_markup import rich_markup
from perilune.analysis.documents.render.html import panel_of
from perilune.analysis.runtime.flight.results import FlightResult

from .landing import landing_panels, vector
from .readme_figure import LANDING


@dataclass(frozen=True)
class Published:
    """A row of the published table: success rate (0 to 1), errors as (mean, standard deviation) in m and m/s."""

    method: str
    success_rate: float
    position_error: tuple[float, float]
    velocity_error: tuple[float, float]


# Fomichev and Li 2017, 10 000 trials; errors of the successful ones.
PUBLISHED = {
    "analytic_guidance": Published("analytic", 1.0, (0.4456, 0.2883), (0.4390, 0.2336)),
    "astar_guidance": Published("A*", 0.829, (0.4568, 0.6455), (1.0196, 1.2049)),
    "astar_modified_guidance": Published("modified A*", 0.935, (2.2596, 6.6021), (1.3355, 1.5896)),
}
COMPARED = ("position_error", "velocity_error")


def write_demo_page(landing: FlightResult, sample: list[FlightResult], batch: CampaignResult, path: Path) -> None:
    """Write the page. Raises KeyError for a variant that the publication does not contain."""
    target = np.array([landing.provenance["parameters"][f"guidance.target_position[{i}]"] for i in (1, 2, 3)])
    campaign, content = batch.plan.campaign, BatchContent(batch)
    distributions = distribution_figures(content, [each for each in campaign.metrics if each.name in COMPARED])
    side, panels = landing_panels(landing, sample)
    write_page(
        path,
        Path(__file__).with_name("demo.html"),
        title="Perilune: a landing, and three guidances compared",
        trial=LANDING,
        landing=landing,
        end_time=float(landing.time[-1]),
        position_error=float(np.linalg.norm(vector(landing, "plant.position")[:, -1] - target)),
        speed=float(np.linalg.norm(vector(landing, "plant.velocity")[:, -1])),
        sample=len(sample),
        side=side,
        panels=panels,
        campaign=campaign,
        provenance=batch.provenance,
        summary=batch.summary,
        published={name: PUBLISHED[name] for name in batch.summary},
        rates=rates_figure(batch, {name: PUBLISHED[name].success_rate for name in batch.summary}),
        looks=[(swatch(style), variant) for variant, style in content.styles.items()],
        distributions=list(map(panel_of, distributions.draw())),
        failures=list(map(panel_of, failure_figures(batch))),
        outcomes=rich_markup(outcome_marks()),
        trials=trials_document(batch),
    )
