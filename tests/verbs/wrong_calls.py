"""Calls of public functions that mypy refuses, each with the code of its error; never run."""

import perilune

perilune.batch("lunar_landing", "compare", trails=100)  # type: ignore[call-arg]
perilune.batch("lunar_landing", "compare", trials="100")  # type: ignore[arg-type]
perilune.batch("lunar_landing", "compare", engine="thread")  # type: ignore[arg-type]
perilune.simulate("lunar_landing", open_inputs="ignore")  # type: ignore[arg-type]
perilune.simulate("lunar_landing", use=["guidance"])  # type: ignore[arg-type]
perilune.simulate("lunar_landing", stop_time="10 s")  # type: ignore[arg-type]
perilune.stability("lunar_landing", loop=["attitude"])  # type: ignore[call-arg]
perilune.rare("lunar_landing", "compare", samples=1.5)  # type: ignore[arg-type]
perilune.worst("lunar_landing", "compare", margin="disc")  # type: ignore[arg-type]
