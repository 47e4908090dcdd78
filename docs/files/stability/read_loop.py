import json

import control
import numpy as np

with open("attitude/loops.json", encoding="utf-8") as file:
    loop = json.load(file)["loops"][0]
L = control.ss(loop["A"], loop["B"], loop["C"], loop["D"], loop["model_period_s"])
response = control.frd(L, np.array(loop["frequency_rad_s"]))
gain, phase, phase_crossover, gain_crossover = control.margin(response)
print(f"{20 * np.log10(gain):.2f} dB at {phase_crossover:.3f} rad/s, {phase:.2f} deg at {gain_crossover:.3f} rad/s")
assert abs(phase - loop["phase_margin_deg"]) < 0.01
