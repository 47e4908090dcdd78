"""Use of an FMU in systems: as a component, or as a variant in a campaign."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from perilune.analysis.campaigns.definition.campaign_source import read_source
from perilune.analysis.runtime.ssp.archive import open_system, system_names
from perilune.analysis.runtime.ssp.ssd_reader import read_description
from perilune.analysis.runtime.ssp.system_description import Component, SystemElement


@dataclass
class Usage:
    """Use of an FMU: components by system, and by system the campaigns of which it is a variant."""

    components: dict[str, list[str]] = field(default_factory=dict)
    campaigns: dict[str, list[str]] = field(default_factory=dict)


@cache
def usages() -> dict[str, Usage]:
    """Return the use of every FMU, by name, in all systems of ssp_systems."""
    uses: dict[str, Usage] = {}
    for system in system_names():
        archive = open_system(system)
        for component, fmu in components_of(read_description(archive).system):
            uses.setdefault(fmu, Usage()).components.setdefault(system, []).append(component)
        for name in sorted(archive.campaign_names()):
            campaign = read_source(*archive.campaign(name), archive).table().content
            for fmus in campaign.get("compare", {}).values():
                for fmu in fmus:
                    uses.setdefault(fmu, Usage()).campaigns.setdefault(system, []).append(name)
    return uses


def components_of(system: SystemElement, within: str = "") -> list[tuple[str, str]]:
    """Return the components of a system and its nested systems, each with the name of its FMU."""
    uses: list[tuple[str, str]] = []
    for element in system.elements.values():
        if isinstance(element, Component):
            uses.append((within + element.name, Path(element.source).stem))
        elif isinstance(element, SystemElement):
            uses += components_of(element, f"{within}{element.name}.")
    return uses
