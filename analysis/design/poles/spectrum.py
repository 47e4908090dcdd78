"""Required spectra: poles closed under conjugation, their real matrices, and their distribution over levels."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import block_diag
from scipy.optimize import linear_sum_assignment

from ....common.errors import InputError

_CONJUGATE = 1e-8  # relative; agreement of a pole with its conjugate in the input


@dataclass(frozen=True)
class Spectrum:
    """Spectrum: the real poles, and the pole with positive imaginary part of each conjugate pair, both ascending."""

    real: tuple[float, ...] = ()
    pairs: tuple[complex, ...] = ()

    @classmethod
    def of(cls, poles: ArrayLike, size: int, name: str = "poles") -> Spectrum:
        """Return the spectrum of ``size`` poles. Raises InputError for a different number or unpaired complex poles."""
        values = np.asarray(poles)
        if values.dtype.kind not in "biufc" or values.ndim != 1 or not np.all(np.isfinite(values)):
            raise InputError("modal", name, "not a list of finite numbers", "give real or complex numbers")
        if len(values) != size:
            raise InputError(
                "modal",
                name,
                f"{len(values)} poles",
                f"give {size} poles, with each repeated pole listed as often as it occurs",
            )
        conjugates = [complex(pole).conjugate() for pole in values if pole.imag < 0.0]
        pairs = []
        for pole in [complex(pole) for pole in values if pole.imag > 0.0]:
            partner = _remove_nearest(conjugates, pole)
            if partner is None:
                raise _alone(name, pole)
            pairs.append(0.5 * (pole + partner))
        if conjugates:
            raise _alone(name, conjugates[0].conjugate())
        return cls.sort([float(pole.real) for pole in values if pole.imag == 0.0], pairs)

    @classmethod
    def sort(cls, real: Sequence[float], pairs: Sequence[complex]) -> Spectrum:
        return cls(tuple(sorted(real)), tuple(sorted(pairs, key=lambda pole: (pole.real, pole.imag))))

    @property
    def size(self) -> int:
        return len(self.real) + 2 * len(self.pairs)

    @property
    def poles(self) -> np.ndarray:
        """All poles (n,), conjugates next to each other."""
        both = [pole for pair in self.pairs for pole in (pair, pair.conjugate())]
        return np.array([*self.real, *both], dtype=complex)

    @property
    def matrix(self) -> np.ndarray:
        """Real matrix with these poles: diagonal, with [a b; -b a] for a pair a +- i b."""
        blocks = [np.array([[pair.real, pair.imag], [-pair.imag, pair.real]]) for pair in self.pairs]
        return block_diag(np.diag(self.real), *blocks) if self.real else block_diag(*blocks)

    @property
    def polynomial(self) -> np.ndarray:
        """Coefficients of the monic polynomial with these roots, ascending; the last is 1."""
        return np.real(np.poly(self.poles))[::-1] if self.size else np.ones(1)

    def splits(self, size: int) -> Iterator[tuple[Spectrum, Spectrum]]:
        """Yield every subset of ``size`` poles that is closed under conjugation, with the remaining poles."""
        known = set()
        for count in range(min(size // 2, len(self.pairs)) + 1):
            for pairs in combinations(range(len(self.pairs)), count):
                for real in combinations(range(len(self.real)), size - 2 * count):
                    part = Spectrum(tuple(self.real[i] for i in real), tuple(self.pairs[i] for i in pairs))
                    if part not in known:
                        known.add(part)
                        single = tuple(pole for i, pole in enumerate(self.real) if i not in real)
                        yield part, Spectrum(single, tuple(p for i, p in enumerate(self.pairs) if i not in pairs))

    def without(self, part: Spectrum) -> Spectrum:
        """Return the spectrum without the poles of ``part``. Raises InputError for a missing pole."""
        real, pairs = list(self.real), list(self.pairs)
        for pole in (*part.real, *part.pairs):
            if _remove_nearest(real if isinstance(pole, float) else pairs, pole) is None:
                raise InputError(
                    "modal", "upper", f"{pole:g} is not one of the poles", "choose the upper poles among the poles"
                )
        return Spectrum(tuple(real), tuple(pairs))

    def distribute(self, sizes: Sequence[int]) -> list[Spectrum] | None:
        """Deal the poles to groups of these ``sizes``, neighbouring poles to different groups if possible.

        Pairs are dealt first. The groups take turns, beginning with the largest remaining room. Returns None if the
        pairs do not fit.
        """
        room, real, pairs = list(sizes), _lists(sizes), _lists(sizes)
        if not self._fits(room):
            return None
        for pair in self.pairs:
            index = max(range(len(room)), key=lambda i: (room[i] // 2, -len(pairs[i]), -i))
            pairs[index].append(pair)
            room[index] -= 2
        for pole in self.real:
            index = max(range(len(room)), key=lambda i: (room[i], -i))
            real[index].append(pole)
            room[index] -= 1
        return [Spectrum.sort(*part) for part in zip(real, pairs, strict=True)]

    def split_by_speed(self, sizes: Sequence[int]) -> list[Spectrum] | None:
        """Split the poles into groups of these ``sizes``, fastest first where pairs permit; None if they do not fit.

        A pole goes to the first group that has room for it and leaves room for the pairs that follow.
        """
        room, real, pairs = list(sizes), _lists(sizes), _lists(sizes)
        if not self._fits(room):
            return None
        left = len(self.pairs)
        for pole in sorted([*self.real, *self.pairs], key=abs, reverse=True):
            size = 1 if isinstance(pole, float) else 2
            left -= size == 2
            for index in range(len(room)):
                after = [free - size * (i == index) for i, free in enumerate(room)]
                if after[index] >= 0 and sum(free // 2 for free in after) >= left:
                    (real if size == 1 else pairs)[index].append(pole)
                    room = after
                    break
        return [Spectrum.sort(*part) for part in zip(real, pairs, strict=True)]

    def _fits(self, sizes: Sequence[int]) -> bool:
        return len(self.pairs) <= sum(size // 2 for size in sizes)


def _remove_nearest(poles: list, pole: complex) -> complex | None:
    """Remove the nearest pole from the list; return None if none is equal within rounding."""
    nearest = min(poles, key=lambda other: abs(other - pole), default=None)
    if nearest is None or abs(nearest - pole) > _CONJUGATE * abs(pole):
        return None
    poles.remove(nearest)
    return nearest


def _lists(sizes: Sequence[int]) -> list[list]:
    return [[] for _ in sizes]


def match(desired: np.ndarray, actual: np.ndarray) -> np.ndarray:
    """Return the required pole for each pole found, one to one, with the least sum of distances."""
    rows, columns = linear_sum_assignment(np.abs(actual[:, None] - desired[None, :]))
    return desired[columns[np.argsort(rows)]]


def distance(desired: np.ndarray, actual: np.ndarray) -> float:
    """Return the largest distance between matched poles."""
    return float(np.max(np.abs(match(desired, actual) - actual), initial=0.0))


def _alone(name: str, pole: complex) -> InputError:
    return InputError("modal", name, f"{pole:g} lacks its conjugate", f"also give {pole.conjugate():g}")
