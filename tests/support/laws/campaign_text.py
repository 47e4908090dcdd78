"""A small synthesis: four descents at coarse steps, few candidates."""

SEARCH = """
[network_operator]
component = "guidance"
law = "diveev_2013_basic"
step = 0.5
stop_time = 320
population = 8
generations = 3
crossovers = 6
variations = 4
elites = 2
renewal = 2

[network_operator.objectives]
altitude = "abs(final_altitude - 1500) + 100 * ground_hit"
speed = "final_speed"
"""
CAMPAIGN = """
system = "lunar_descent_2d"
trials = 4
seed = 11

[set]
"sensor.sample_period" = 0.5
"sensor.altitude_noise" = 0.02

[draw."plant.initial_altitude"]
distribution = "grid"
values = [16648, 19648]

[metric.final_altitude]
expression = "plant.altitude"
reduction = "final"

[metric.final_speed]
expression = "plant.speed"
reduction = "final"

[metric.ground_hit]
expression = "plant.ground_contact"
reduction = "final"

[success]
expression = "final_speed < 6 and 1200 <= final_altitude <= 1800"
"""
TEXT = CAMPAIGN + SEARCH
