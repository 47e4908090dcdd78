"""Whether contestants arrive where this project's loop does: a time counts only for the same flight."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from .contestant import Contestant, Values

TOLERANCE = 1e-9


def difference(values: Values, reference: Values) -> float:
    """Largest difference, relative to the reference or to 1 where that is larger."""
    return max(abs(values[name] - expected) / max(1.0, abs(expected)) for name, expected in reference.items())


def differ(values: Values, reference: Values) -> int:
    """Number of values that are not equal to the last bit."""
    return sum(values[name].hex() != expected.hex() for name, expected in reference.items())


def disagreements(contestants: Iterable[Contestant], final: Mapping[str, Values]) -> dict[str, str]:
    """Contestants that flew elsewhere than ours by the same algorithm, with the reason.

    One that is exact must have been compared with ours.
    """
    by_name = {each.name: each for each in contestants}
    ours = {
        (each.flavour, each.algorithm): final[each.name]
        for each in by_name.values()
        if each.is_ours and each.name in final
    }
    versions: dict[str, str] = {}
    for name, values in final.items():
        reference = ours.get((by_name[name].flavour, by_name[name].algorithm))
        if reference is None:
            if by_name[name].exact:
                versions[name] = "ours did not fly, so that its values cannot be compared"
        elif by_name[name].exact and differ(values, reference):
            versions[name] = f"{differ(values, reference)} of its values at the end differ from ours in their bits"
        elif not difference(values, reference) <= TOLERANCE:
            versions[name] = f"its values at the end differ from ours by {difference(values, reference):.2g}"
    return versions
