"""Page of `perilune show`, with the information on campaigns that its script needs before the first request."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...common.errors import InputError
from ..documents.common.colours import COLOURS
from ..documents.common.page import render_page
from ..documents.common.quantities import display_factor, display_unit
from ..documents.interactive.script_bundles import MISSING, read_bundle
from .documents import CampaignEntry, ShowDocument
from .opened_campaign import OpenCampaign
from .scale import BARS, BINS

BUNDLE = "show"
FIRST_FIGURES = 6  # number of histograms shown initially


def show_page(campaigns: Sequence[OpenCampaign]) -> str:
    """Return the HTML page with its script. Raises InputError if the script was not built."""
    if read_bundle(BUNDLE) is None:
        problem, _, remedy = MISSING.partition(": ")
        raise InputError("perilune show", "", problem, remedy.rstrip("."))
    template = Path(__file__).with_name("show.html")
    document: ShowDocument = {
        "campaigns": [_document(campaign) for campaign in campaigns],
        "bins": BINS,
        "bars": BARS,
        "figures": FIRST_FIGURES,
    }
    style = template.with_name("show.css").read_text(encoding="utf-8")
    return render_page(template, title="Campaigns", document=document, own_style=style, bundle=BUNDLE)


def _document(campaign: OpenCampaign) -> CampaignEntry:
    provenance = campaign.source.provenance
    return {
        "folder": campaign.source.folder.name,
        "system": provenance["system"],
        "description": provenance.get("description", ""),
        "criterion": provenance["success"],
        "trials": provenance["trials"],
        "flown": campaign.source.flown,
        "variants": [
            {"name": name, "colour": COLOURS[number % len(COLOURS)]} for number, name in enumerate(campaign.variants)
        ],
        "quantities": [
            {
                "name": name,
                "unit": display_unit(column.unit),
                "factor": display_factor(column.unit),
                "meaning": column.meaning,
            }
            for name, column in campaign.quantities.items()
        ],
    }
