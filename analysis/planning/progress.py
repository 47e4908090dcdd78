"""How far a plan of several parts is, on a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Protocol, TypeVar

from tqdm import tqdm

T = TypeVar("T")


class Part(Protocol):
    """Runs a part of a plan and counts it when it is done."""

    def __call__(self, work: Callable[[], T]) -> T: ...


@contextmanager
def counted(parts: int) -> Iterator[Part]:
    """A bar of so many parts on standard error, if that is a terminal."""
    with tqdm(total=parts, unit="part", disable=None, leave=False) as bar:

        def part(work: Callable[[], T]) -> T:
            found = work()
            bar.update()
            return found

        yield part
