"""Hand-written run through phases, with closed-form results, and its declared figures.

There are 401 rows, half a second apart. Phase 1 lasts to 20 s, phase 2 to 150 s, phase 4 to 180 s, with `done` from 165
s on, followed by phase 5.
"""

import numpy as np

from perilune.analysis.documents.figures.declared import (
    BoundValues,
    BudgetFigure,
    BudgetItem,
    CurveFigure,
    Limit,
    LimitsFigure,
    PathFigure,
    PathPoint,
    PhasesFigure,
    SampleRange,
    SequencerPhase,
)
from perilune.analysis.runtime.ssp.conversions import Unit
from tests.support.pages.own_samples import DEG, DEGREE, TIME, flown, scalar

METRE = Unit("m", (0, 1, 0, 0, 0, 0, 0, 0))
KILOGRAM = Unit("kg", (1, 0, 0, 0, 0, 0, 0, 0))
PHASES = PhasesFigure(
    title="Phases",
    notes=(),
    signal=scalar("ship.phase"),
    phases=(
        SequencerPhase(1, "burn", None),
        SequencerPhase(2, "coast", None),
        SequencerPhase(4, "capture", scalar("ship.done")),
        SequencerPhase(4, "hover", None),
        SequencerPhase(5, "descent", None),
    ),
    spent=scalar("ship.mass", KILOGRAM),
    status=scalar("ship.status"),
    status_times=None,
    meanings={2: "the plan was late", 6: "no probe"},
)
SPANS = [  # name, begin, end (s), spent (kg)
    ("burn", 0.0, 20.0, 10.0),
    ("coast", 20.0, 150.0, 0.0),
    ("capture", 150.0, 165.0, 3.0),
    ("hover", 165.0, 180.0, 3.0),
    ("descent", 180.0, 200.0, 8.0),
]
BUDGET = BudgetFigure(
    title="Budget",
    notes=(),
    of=PHASES,
    items=(
        BudgetItem("bound", (), ("landing",), ()),
        BudgetItem("capture and descent over it", ("capture", "descent"), (), ("landing",)),
        BudgetItem("hover", ("hover",), (), ()),
    ),
    bound=BoundValues(("landing",), {"landing": 9.5}),
)
LIMITS = LimitsFigure(
    title="Contact",
    notes=(),
    limits=(
        Limit(scalar("ship.tilt", DEG, 1.0 / DEGREE), "tilt", None, 5.0),
        Limit(scalar("ship.mass", KILOGRAM), "mass", 80.0, None),
        Limit(scalar("ship.x", METRE), "east", -10.0, 10.0),
    ),
)
WHERE = SampleRange(scalar("ship.phase"), 4.0, None)
PATH = PathFigure(
    title="Plan view",
    notes=(),
    x=scalar("ship.x", METRE),
    y=scalar("ship.y", METRE),
    equal=True,
    points=(PathPoint(scalar("ship.site_x", METRE), scalar("ship.site_y", METRE), "site"),),
    rows=WHERE,
)
CURVE = CurveFigure(
    title="Tilt",
    notes=(),
    signals=(scalar("ship.tilt", DEG, 1.0 / DEGREE), scalar("ship.lean", DEG, 1.0 / DEGREE)),
    labels=("tilt", "lean"),
    low=None,
    high=5.0,
    together=False,
    rows=WHERE,
)
FIGURES = [PHASES, BUDGET, LIMITS, PATH, CURVE]


def mission(**changed):
    """Return the run; signals may be ``changed``."""
    phase = np.select([TIME < 20.0, TIME < 150.0, TIME < 180.0], [1, 2, 4], 5)
    mass = np.interp(TIME, [0.0, 20.0, 150.0, 180.0, 200.0], [100.0, 90.0, 90.0, 84.0, 76.0])
    signals = {
        "phase": phase,
        "done": (TIME >= 165.0) & (TIME < 180.0),
        "mass": mass,
        "status": np.select([TIME < 30.0, TIME < 40.0, TIME < 190.0], [0, 2, 0], 6),
        "x": np.interp(TIME, [150.0, 200.0], [500.0, 8.0]),
        "y": np.interp(TIME, [150.0, 200.0], [300.0, 0.0]),
        "site_x": np.where(TIME < 180.0, 100.0, 10.0),
        "site_y": 0.0 * TIME,
        "tilt": np.interp(TIME, [150.0, 200.0], [60.0, 7.5]) * DEGREE,
        "lean": 2.0 * DEGREE + 0.0 * TIME,
    }
    return flown(**(signals | changed))
