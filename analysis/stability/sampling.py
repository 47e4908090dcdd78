"""Margins with another communication step: what the exchange of signals costs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from analysis.errors import InputError

from .bench import StudyError
from .declaration import Loop, Point
from .followed import ONE_STEP, margins_of
from .point_study import PointStudy
from .results import Sampled
from .subject import Subject

FACTORS = (0.5, 1.0, 2.0)  # of the communication step


def sampled(
    subject: Subject, point: Point, loops: Sequence[Loop], step: float, cells: Sequence[int]
) -> dict[str, list[Sampled]]:
    """Margins of every channel with half, the same and twice the communication step ``step`` (s).

    ``cells`` is the memory that matters at this point. A step that the FMUs refuse has their reason as its note.
    """
    found: dict[str, list[Sampled]] = {}
    failed: list[Sampled] = []
    for factor in FACTORS:
        try:
            with PointStudy(subject.changed(step=factor * step), point, loops) as study:
                study.linearise(cells, ONE_STEP)
                if study.linear is None:
                    raise StudyError(study.why_not)
                for channel in study.channels:
                    margins = margins_of(study.linear, channel.name)
                    gain = margins.gain if np.isfinite(margins.gain) else None
                    phase = margins.phase if np.isfinite(margins.phase) else None
                    found.setdefault(channel.name, []).append(Sampled(factor * step, gain, phase))
        except (InputError, StudyError) as error:
            failed.append(Sampled(factor * step, None, None, str(error)))
    return {name: sorted([*items, *failed], key=lambda item: item.step) for name, items in found.items()}
