"""Result of the benchmark as a text table."""

from __future__ import annotations

from typing import Any

from .contestant import OURS


def benchmark_text(document: dict[str, Any]) -> str:
    """Return the result of `run_benchmark` as a table, slowest contestant first, native FMUs below Python FMUs."""
    lines = [
        f"{document['system']}: {document['steps']} steps of {document['step']:g} s, {document['repeats']} repeats",
        "",
        f"{'':34}{'us per step':>12}{'median':>9}{'ratio':>9}{'ms to start':>13}",
    ]
    best = document["microseconds_per_step"]
    for flavour in OURS:
        names = [name for name, each in document["flavours"].items() if each == flavour and name in best]
        if names:
            lines.append(f"{flavour} FMUs")
        for name in sorted(names, key=lambda name: -best[name]):
            middle = document["median_microseconds_per_step"][name]
            start = document["milliseconds_to_start"][name]
            ratio = f"{document['ratios'][name]:9.3g}" if name in document["ratios"] else f"{'':9}"
            lines.append(f"  {name:32}{best[name]:12.3g}{middle:9.3g}{ratio}{start:13.3g}")
    lines += ["", "ratio: time per step over that of our loop on the same FMUs, median of paired runs", ""]
    for name, ratio in document["promised_ratios"].items():
        lines.append(f"{name:50}{ratio:8.4g}")
    lines += [""]
    for flavour, rates in document["trials_per_second"].items():
        text = ", ".join(f"{rate:.4g} with {workers}" for workers, rate in rates.items())
        lines.append(f"trials per second, {flavour} FMUs, by workers: {text}")
    lines += [f"not measured: {name}: {reason}" for name, reason in document["unavailable"].items()]
    machine = document["machine"]
    lines.append(f"{machine['processor']}, {machine['processors']} in use, {machine['system']}")
    lines.append(", ".join(f"{name} {number}" for name, number in document["versions"].items()))
    return "\n".join(lines)
