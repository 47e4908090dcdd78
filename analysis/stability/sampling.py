"""Margins with another communication step: what the exchange of signals costs."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..common.errors import InputError
from .followed import ONE_STEP, margins_of, model_of
from .point.bench import StudyError
from .point.point_study import PointStudy
from .request.declaration import Loop, Point
from .request.subject import Subject
from .results.varied import Sampled

FACTORS = (0.5, 1.0, 2.0)  # of the communication step


def vary_step(
    subject: Subject,
    point: Point,
    loops: Sequence[Loop],
    step: float,
    cells: Sequence[int],
    names: Sequence[str],
    tell: Callable[[int, int], None],
) -> dict[str, list[Sampled]]:
    """Margins of the channels ``names`` with half, the same and twice the communication step ``step`` (s).

    ``cells`` is the memory that matters at this point. Where there are no margins the note says why. ``tell`` is told
    how many steps are expected and done.
    """
    tell(len(FACTORS), 0)
    by_name: dict[str, list[Sampled]] = {name: [] for name in names}
    for factor in FACTORS:
        try:
            with PointStudy(subject.with_options(step=factor * step), point, loops) as study:
                study.linearise(cells, ONE_STEP)
                if study.linear is None:
                    raise StudyError(study.why_not)
                rows = [Sampled(factor * step, margins_of(model_of(study.linear, name))) for name in names]
        except (InputError, StudyError) as error:
            rows = [Sampled(factor * step, None, str(error))] * len(names)
        for name, row in zip(names, rows, strict=True):
            by_name[name].append(row)
        tell(0, 1)
    return by_name
