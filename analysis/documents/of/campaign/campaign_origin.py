"""Origin of a campaign's numbers: dispersed parameters, and FMUs of the variants."""

from __future__ import annotations

from ....campaigns.definition.campaign import Campaign
from ...cell import Code
from ...model import Table


def parameter_table(campaign: Campaign) -> Table:
    """Return dispersed parameters as declared, then derived ones, then tables of lookups."""
    rows = []
    for draw in campaign.draws:
        distribution = draw.distribution
        rows.append((", ".join(draw.names), distribution.keyword.replace("_", " "), distribution.describe()))
    rows += [(name, "derived", " ".join(formula.text.split())) for name, formula in campaign.derived.items()]
    rows += [(each.name, "lookup", f"{each.column} of {each.file}") for each in campaign.lookups]
    body = [(name, distribution, Code(arguments, is_long=True)) for name, distribution, arguments in rows]
    return Table(("name", "distribution", "arguments"), body)


def fmu_rows(fmus: dict[str, dict[str, str]]) -> list[tuple[str, str, str]]:
    """Return component, variants and SHA-256 of every FMU; variants with the same FMU share a row."""
    variants_of: dict[tuple[str, str], list[str]] = {}
    for variant, components in fmus.items():
        for component, digest in components.items():
            variants_of.setdefault((component, digest), []).append(variant)
    return [
        (component, "all" if len(variants) == len(fmus) else ", ".join(variants), digest)
        for (component, digest), variants in sorted(variants_of.items(), key=lambda item: item[0][0])
    ]
