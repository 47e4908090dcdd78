"""Progress bars that a test counts."""

from __future__ import annotations

from typing import Any

from tqdm import tqdm


class Bars:
    """Recorded progress of every bar of a module: (steps done, steps expected), and the number of its updates."""

    def __init__(self) -> None:
        self.ends: list[tuple[float, float]] = []
        self.moves: list[int] = []


def watched(monkeypatch: Any, module: Any, name: str = "ProgressLines") -> Bars:
    """Record the bars that ``module`` creates of the class ``name`` from now on, where standard
    error is no terminal."""
    bars = Bars()

    class Watched(tqdm):
        def __init__(self, *arguments: Any, **options: Any) -> None:
            self.moved = 0
            super().__init__(*arguments, **(options | {"mininterval": 0.0, "miniters": 1, "disable": False}))

        def update(self, n: float | None = 1) -> Any:
            self.moved += bool(n)
            return super().update(n)

        def close(self) -> None:
            if not self.disable:  # which closing sets
                bars.ends.append((self.n, self.total))
                bars.moves.append(self.moved)
            super().close()

    monkeypatch.setattr(module, name, Watched)
    return bars
