"""Single FMUs by pythonfmu: dynamic, with direct feedthrough, with a step that hangs, with log messages."""

from __future__ import annotations

import re
from pathlib import Path

from pythonfmu import FmuBuilder

from tests.support.builders import retouched

DYNAMIC = """
from pythonfmu import Fmi2Causality, Fmi2Initial, Fmi2Slave, Fmi2Variability, Real


class Dynamic(Fmi2Slave):
    def __init__(self, **keywords):
        super().__init__(**keywords)
        self.force, self.level, self.damping, self.x, self.v, self.seen = 0.5, 0.25, 0.3, 1.0, 0.0, 0.0
        continuous = Fmi2Variability.continuous
        self.register_variable(Real("force", causality=Fmi2Causality.input, variability=continuous))
        self.register_variable(Real("level", causality=Fmi2Causality.input, variability=Fmi2Variability.discrete))
        self.register_variable(
            Real("damping", causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable)
        )
        self.register_variable(Real("x", causality=Fmi2Causality.output))
        self.register_variable(Real("v", causality=Fmi2Causality.output))
        self.register_variable(Real("seen", causality=Fmi2Causality.output, initial=Fmi2Initial.calculated))

    def exit_initialization_mode(self):
        self.seen = self.force + 10.0 * self.level

    def do_step(self, current_time, step_size):
        self.x += step_size * self.v
        self.v += step_size * (self.force + self.level - self.damping * self.v - self.x)
        return True
"""

# The loader reads Python's attributes whenever outputs are asked for: these follow the inputs that are set then.
FOLLOWER = """
from pythonfmu import Boolean, Fmi2Causality, Fmi2Slave, Fmi2Variability, Integer, Real


class Follower(Fmi2Slave):
    def __init__(self, **keywords):
        super().__init__(**keywords)
        self.u, self.d, self.n, self.b = 0.5, 0.25, 3, True
        for kind, name, variability in (
            (Real, "u", Fmi2Variability.continuous),
            (Real, "d", Fmi2Variability.discrete),
            (Integer, "n", Fmi2Variability.discrete),
            (Boolean, "b", Fmi2Variability.discrete),
        ):
            self.register_variable(kind(name, causality=Fmi2Causality.input, variability=variability))
            getter = lambda name=name: getattr(self, name)
            self.register_variable(
                kind(f"{name}_out", causality=Fmi2Causality.output, variability=variability, getter=getter)
            )

    def do_step(self, current_time, step_size):
        return True
"""

HANGING = """
import time

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Hanging(Fmi2Slave):
    def __init__(self, **keywords):
        super().__init__(**keywords)
        self.y, self.at, self.pause = 0.0, 1e9, 1e9
        self.register_variable(Real("y", causality=Fmi2Causality.output))
        for name in ("at", "pause"):
            self.register_variable(
                Real(name, causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable)
            )

    def do_step(self, current_time, step_size):
        self.y += step_size
        if current_time >= self.at:
            time.sleep(self.pause)
        return True
"""

# C code that keeps Python's lock while it sleeps: no other thread of the process runs.
HOLDING = (
    HANGING.replace("class Hanging", "class Holding")
    .replace("import time", "import ctypes")
    .replace("time.sleep(self.pause)", "ctypes.PyDLL(None).usleep(int(1e6 * self.pause))")
)

# It takes the process with it.
TALKING = """
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real
from pythonfmu.enums import Fmi2Status


class Talking(Fmi2Slave):
    def __init__(self, **keywords):
        super().__init__(**keywords)
        self.y, self.fails_at = 0.0, 1e9
        self.register_variable(Real("y", causality=Fmi2Causality.output))
        self.register_variable(
            Real("fails_at", causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable)
        )

    def exit_initialization_mode(self):
        self.log("ready", Fmi2Status.ok, "logAll")

    def do_step(self, current_time, step_size):
        self.y = current_time + step_size
        self.log(f"stepped to {self.y}", Fmi2Status.ok, "logAll")
        if abs(self.y - 0.5) < 1e-9:
            self.log("half way", Fmi2Status.warning)
        if self.y >= self.fails_at:
            self.log("too far\\nthat is", Fmi2Status.error)
            return False
        return True
"""

VARIABLE_STEPS = "canHandleVariableCommunicationStepSize"
SOURCES = {
    "Dynamic": DYNAMIC,
    "Follower": FOLLOWER,
    "Hanging": HANGING,
    "Holding": HOLDING,
    "Talking": TALKING,
}


def build_lone_fmu(name: str, folder: Path, experiment: str = "") -> Path:
    """Build one of the FMUs above, with the attributes ``experiment`` as its default experiment.

    It requests steps of one size, so that FMPy does not put further ones in at events.
    """
    script = folder / f"{name.lower()}.py"
    script.write_text(SOURCES[name])
    FmuBuilder.build_FMU(script, folder)
    path = folder / f"{name}.fmu"

    def change(text: str) -> str:
        text = re.sub(r"<DefaultExperiment[^>]*/>", "", text)
        text = text.replace(f'{VARIABLE_STEPS}="true"', f'{VARIABLE_STEPS}="false"')
        declared = f"<DefaultExperiment {experiment}/><ModelVariables>" if experiment else "<ModelVariables>"
        return text.replace("<ModelVariables>", declared)

    return retouched(path, path, change)
