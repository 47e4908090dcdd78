"""Enumerations: plain ints with names and meanings, for statuses, phases, modes and methods.

    class SteeringStatus(Enumeration):
        GOOD = member("good")
        LIMITED = member("rate limited")

`SteeringStatus.LIMITED` is the int 1 in Python and a constant in C. `Output(SteeringStatus)`, for example, declares an
Integer bounded by the first and last number; its description lists the meanings.
"""

from __future__ import annotations

from typing import Any, ClassVar


def member(meaning: str) -> int:
    """Declare a member of an `Enumeration` with its meaning."""
    created: Any = _Member(meaning)
    return created


class _Member:
    def __init__(self, meaning: str) -> None:
        self.meaning = meaning


class Enumeration:
    """Base of enumerations, with members numbered from 0, or from n with ``class Phase(Enumeration, first=n)``."""

    meanings: ClassVar[dict[int, str]] = {}  # by number
    names: ClassVar[dict[int, str]] = {}

    def __init_subclass__(cls, *, first: int = 0) -> None:
        members = [(name, value) for name, value in vars(cls).items() if isinstance(value, _Member)]
        cls.meanings = {}
        cls.names = {}
        for number, (name, value) in enumerate(members, first):
            setattr(cls, name, number)
            cls.meanings[number] = value.meaning
            cls.names[number] = name

    @classmethod
    def describe(cls, about: str) -> str:
        """Return a description that lists all members: ``about: 0 good, 1 rate limited``.

        If ``about`` is empty, the docstring of the class replaces it.
        """
        members = ", ".join(f"{number} {meaning}" for number, meaning in cls.meanings.items())
        summary = (cls.__doc__ or "").partition("\n")[0].rstrip(".")
        about = about or summary[:1].lower() + summary[1:]
        return f"{about}: {members}" if about else members
