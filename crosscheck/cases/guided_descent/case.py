"""A guidance FMU of Perilune flies a lander of Basilisk: braking to a point over a flat Moon."""

from crosscheck.case import POSITION, VELOCITY, Case

GRAVITY, MASS = 1.62, 940.0  # m/s2, kg
START = (1.0e5, 0.0, 1.05e4)  # m, landing site frame
SPEED = (-948.8127469, 0.0, -47.4802098)  # m/s
TARGET = (0.0, 0.0, 2000.0)  # m
FMU = "build/fmus/native/analytic_guidance.fmu"

CASE = Case(
    title="guidance FMU in Basilisk",
    verifies="analytic_guidance, stepped by FMPy inside a Basilisk simulation, in closed loop with Basilisk's motion",
    gravitation="uniform, 1.62 m/s2",
    environment="none",
    integrator="Simpson's rule here, Runge-Kutta of fourth order in Basilisk",
    matched="here the system lunar_terminal_guidance with ideal navigation. In Basilisk thrust has over each step the "
    "direction of its middle, here it turns",
    step=0.1,
    duration=200.0,
    quantities={"position": POSITION, "velocity": VELOCITY},
    bounds={"position": 1e-3, "velocity": 1e-4},
)
