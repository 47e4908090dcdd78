"""Reproduce the check inside an FMU with FMPy, without Perilune."""

import zipfile

import fmpy
import numpy as np
from fmpy.util import read_csv
from lxml import etree

with zipfile.ZipFile("flat_moon_lander.fmu") as archive:
    archive.extractall("unpacked")
folder = "unpacked/extra/org.fmi-standard.fmi-ls-ref/"
reference, parameters = read_csv(folder + "check.csv"), etree.parse(folder + "check.ssv").findall(".//{*}Parameter")
check = etree.parse(folder + "check.exp").find("Experiment[@name='check']")
times, signals = check.find("TransientSimulation"), {signal.get("name"): signal for signal in check.iter("Signal")}
result = fmpy.simulate_fmu(
    "flat_moon_lander.fmu",
    start_values={parameter.get("name"): parameter[0].get("value") for parameter in parameters},
    output=list(signals),
    step_size=float(times.get("stepSize")),
    input=reference[[name for name in reference.dtype.names if name not in signals]],
    output_interval=float(times.get("stepSize")),
    stop_time=float(times.get("stopTime")),
)
for name, limit in signals.items():
    permitted = float(limit.get("absolute")) + float(limit.get("relative")) * abs(reference[name])
    assert np.all(abs(result[name] - reference[name]) <= permitted), name
