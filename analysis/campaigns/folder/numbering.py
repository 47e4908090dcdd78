"""Division of trials into shards, and shard numbers on a command line."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ....common.bounds import SHARDS
from ....common.errors import InputError

LEAST, MOST, PARTS = 25, 5000, 40  # least and most trials in a shard, and number of shards between these limits

LONGEST = 40  # most characters of a number or a span


@dataclass(frozen=True)
class Numbering:
    """Division of a campaign's ``trials`` into shards of ``size`` trials; the last shard contains the remainder."""

    trials: int
    size: int

    @property
    def count(self) -> int:
        return -(-self.trials // self.size)

    def of(self, shard: int) -> range:
        return range(shard * self.size, min((shard + 1) * self.size, self.trials))


def shard_size(trials: int) -> int:
    """Return the number of trials in a shard, which depends on the campaign only, not on machine or workers."""
    return min(max(-(-trials // PARTS), LEAST), MOST)


def format_shards(shards: Sequence[int]) -> str:
    """Return ascending shard numbers as text for `perilune shard`, such as 0-3 7."""
    starts = [shard for index, shard in enumerate(shards) if index == 0 or shards[index - 1] != shard - 1]
    ends = [shard for index, shard in enumerate(shards) if index == len(shards) - 1 or shards[index + 1] != shard + 1]
    pairs = zip(starts, ends, strict=True)
    return " ".join(str(first) if first == last else f"{first}-{last}" for first, last in pairs)


def parse_shards(texts: Iterable[str]) -> list[int]:
    """Return the shards in a list of numbers and spans (A-B), ascending and without repetition. Raises InputError."""
    numbers: set[int] = set()
    for text in texts:
        first, dash, last = text.partition("-")
        if len(text) > LONGEST:
            raise InputError(
                "shard", text, "neither a shard's number nor a range", "give a number such as 3, or a range such as 0-7"
            )
        if not first.isdecimal() or (dash and not last.isdecimal()) or int(last or first) < int(first):
            raise InputError(
                "shard", text, "neither a shard's number nor a range", "give a number such as 3, or a range such as 0-7"
            )
        SHARDS.check(int(last or first), "shard", text)
        numbers |= set(range(int(first), int(last or first) + 1))
    return sorted(numbers)
