"""Studies of tiny systems with exactly known loops, as by `perilune stability`, for the tests of pages.

Four systems of exact_systems.py: a double integrator with delay, over a campaign with unstable trials and over a sweep
into instability; two coupled channels; a relay; a loop of foreign FMUs, studied by injection only.
"""

from __future__ import annotations

import pickle
from dataclasses import dataclass, replace
from pathlib import Path

import perilune
from perilune import StabilityReport
from tests.support.builders import component, connection, document, pack, system
from tests.support.loops.exact_systems import ExactSystem, coupled_pair, late_double_integrator, relay_loop, resonance
from tests.support.loops.foreign_fmus import build_foreign_fmus

TRIALS = 24
UNSTABLE_ABOVE = 1.58  # s, derivative gain of the late double integrator; exact_systems.py says it more exactly
SWEEP = '<Sweep name="lead" loop="late" point="there" parameter="control.derivative" low="0.02" high="2.5"/>'
CAMPAIGN = f"""
system = "late_double_integrator"
trials = {TRIALS}
seed = 11

[draw."control.derivative"]
distribution = "uniform"
low = {{low}}
high = {{high}}

[metric.position]
expression = "plant.position"
reduction = "final"

[success]
expression = "abs(position) < 100"
"""
KEPT = "studies.pickle"
LATE = late_double_integrator()
PAIR = coupled_pair()


@dataclass(frozen=True)
class Studies:
    """Reports by what is in them."""

    late: StabilityReport  # dispersed, some trials unstable, and swept into instability
    unstable: StabilityReport  # without derivative
    lost: StabilityReport  # every trial unstable
    pair: StabilityReport  # joint margins
    wild_pair: StabilityReport  # joint, unstable
    relay: StabilityReport
    weak: StabilityReport  # the gain never reaches 1: no phase crossing
    foreign: StabilityReport

    @property
    def everything(self) -> StabilityReport:
        """One report with all that a page can show."""
        parts = (self.late, self.pair, self.relay, self.foreign)
        return replace(
            self.late,
            points=tuple(point for part in parts for point in part.points),
            loops=tuple(loop for part in parts for loop in part.loops),
            joint=tuple(joint for part in parts for joint in part.joint),
        )


def named(exact: ExactSystem, name: str, more: str = "") -> ExactSystem:
    """Return the system with its loop called ``name``, and more in its declaration."""
    ssd = exact.ssd.replace('<Loop name="loop"', f'<Loop name="{name}"').replace("</Stability>", f"{more}</Stability>")
    return replace(exact, ssd=ssd)


def foreign_system(folder: Path) -> Path:
    """Write a system of an integrator in C and a law of stock pythonfmu."""
    ends = "input u Real; output y Real"
    wires = connection("law.y", "plant.u") + connection("plant.y", "law.u")
    parts = component("law", "law", ends), component("plant", "integrator", ends)
    build_foreign_fmus(folder)
    return pack(folder / "foreign.ssp", folder, document(system(*parts, connections=wires), stop=10.0, step=0.1))


def campaign(folder: Path, low: float, high: float) -> str:
    """Write a campaign that draws the derivative gain (s) of the late double integrator."""
    path = folder / f"derivative_{low:g}_{high:g}.toml"
    path.write_text(CAMPAIGN.format(low=low, high=high))
    return str(path)


def make_studies(folder: Path, fmus: Path) -> Studies:
    """Fly and study everything; takes some seconds."""
    late = str(named(LATE, "late", SWEEP).packed(folder, fmus))
    pair = str(named(PAIR, "pair").packed(folder, fmus))
    relay = relay_loop(fmus / "three_level_relay.fmu").packed(folder, fmus)
    return Studies(
        late=perilune.stability(late, campaign=campaign(folder, 0.0, 2.0)),
        unstable=perilune.stability(late, set={"control.derivative": 0.0}),
        lost=perilune.stability(late, campaign=campaign(folder, 1.7, 2.0), trials=3),
        pair=perilune.stability(pair),
        wild_pair=perilune.stability(pair, set={"control.derivative[1]": 0.0}),
        relay=perilune.stability(relay),
        weak=perilune.stability(str(resonance().packed(folder, fmus)), set={"control.gain": 0.05}),
        foreign=perilune.stability(foreign_system(folder), loops=["law.y"], at=1.0, feedthrough=["law"]),
    )


def keep_studies(folder: Path, fmus: Path) -> None:
    """Make them, and keep them in ``folder``."""
    (folder / KEPT).write_bytes(pickle.dumps(make_studies(folder, fmus)))


def kept_studies(folder: Path) -> Studies:
    """Return the studies stored there by `keep_studies`."""
    collected = pickle.loads((folder / KEPT).read_bytes())
    assert isinstance(collected, Studies)
    return collected
