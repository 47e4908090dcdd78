"""The oldest packages that pyproject.toml permits, as constraints of pip: `python -m tests.package.floors`."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Iterator

from perilune.common.paths import ROOT

REQUIREMENT = re.compile(r"([\w.-]+)(?:\[[\w,-]*\])?(?:>=|==)([\w.]+)")
RUN_TIME = ("cluster", "plan", "symbolic", "notebook")  # extras that users install


def floors(requirements: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Yield name and oldest version of each requirement. Raises ValueError for one without a floor."""
    for requirement in requirements:
        match = REQUIREMENT.match(requirement)
        if match is None:
            raise ValueError(f"pyproject.toml: {requirement}: no oldest version; write {requirement}>=VERSION")
        yield match[1], match[2]


def main() -> None:
    """Print the constraints of all that is used at run time."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = [each for name in RUN_TIME for each in project["optional-dependencies"][name]]
    for name, version in floors([*project["dependencies"], *extras]):
        print(f"{name}=={version}")


if __name__ == "__main__":
    main()
