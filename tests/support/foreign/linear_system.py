"""System with failure probabilities in closed form: its outputs are linear in three normal draws."""

from __future__ import annotations

from pathlib import Path

from tests.support.builders import component, document, pack, system
from tests.support.foreign.odd_fmu import odd_fmu

ENDS = "output y Real; output tolerance Real; output length Real"
# y of each is gain / 2 + 2 after 1 s: total is normal with mean 0 and standard deviation 1.
CAMPAIGN = """
system = "linear.ssp"
trials = 8
seed = 7
[draw."a.gain"]
distribution = "normal"
mean = 0
sigma = 1.2
[draw.pair]
distribution = "correlated_normal"
names = ["b.gain", "c.gain"]
mean = [1, -1]
covariance = [[1.0, 0.28], [0.28, 1.0]]
[metric.total]
expression = "a.y + b.y + c.y - 6"
reduction = "final"
[metric.first]
expression = "a.y"
reduction = "final"
[success]
expression = "total < 3.0902323"
"""


def linear_system(folder: Path, extra: str = "") -> tuple[str, str]:
    """Write system and campaign; ``extra`` is more of the campaign."""
    odd_fmu(folder)
    root = system(*(component(name, "odd", ENDS) for name in "abc"))
    path = pack(folder / "linear.ssp", folder, document(root, stop=1.0))
    campaign = folder / "linear.toml"
    campaign.write_text(CAMPAIGN + extra)
    return str(path), str(campaign)
