"""Command switch, compared with its truth table: source of the values, with and without thrust.

Truth: the definition, for all sources and both states of the engine, with a distinct value for every variable.
"""

import pytest

from perilune.fmus_src.sequencing.command_switch import CommandSwitch

COMMAND = {"thrust_acceleration": 1, "thrust_direction": 3, "thrust_direction_rate": 3, "command_time": 1}
COMMAND |= {"burn_duration": 1}


def values(source):
    """Return a command of the source (0: nothing) by name, every value another one."""
    actual, count = {}, 10.0 * source
    for name, size in COMMAND.items():
        actual[name] = [count + k for k in range(size)] if size > 1 else count
        count += size
    return actual


@pytest.mark.parametrize("engine_on", [True, False])
@pytest.mark.parametrize("source", range(4))
def test_the_command_in_charge_is_passed_on(source, engine_on):
    settings = {
        f"{of}_{name}": value
        for k, of in enumerate(("own", "braking", "hover"), 1)
        for name, value in values(k).items()
    }
    switch = CommandSwitch(
        source=source, engine_on=engine_on, hover_angular_acceleration_feed=[7.0, 8.0, 9.0], **settings
    )
    switch.initialize()
    for _ in range(2):
        if source > 0:
            for name, value in values(source).items():
                expected = value if engine_on or name != "thrust_acceleration" else 0.0
                assert getattr(switch, name) == expected, name
        else:
            assert switch.thrust_acceleration == 0.0
            assert switch.thrust_direction == switch.thrust_direction_rate == (0.0, 0.0, 0.0)
        assert switch.angular_acceleration_feed == ((7.0, 8.0, 9.0) if source == 3 else (0.0, 0.0, 0.0))
        switch.step(0.0, 0.1)


def test_a_command_is_held_until_the_requested_plan_is_answered():
    """From braking to a hover guidance that samples later: thrust goes on as it was, and ends where the engine does."""
    switch = CommandSwitch(source=2, engine_on=True, braking_thrust_acceleration=5.0, braking_command_time=7.0)
    switch.initialize()
    switch.source, switch.plan_number, switch.hover_plan = 3, 4, 3
    switch.step(0.0, 0.1)
    assert (switch.thrust_acceleration, switch.command_time) == (5.0, 7.0)
    switch.hover_plan, switch.hover_thrust_acceleration = 4, 2.0
    switch.step(0.1, 0.1)
    assert switch.thrust_acceleration == 2.0
    switch.hover_plan, switch.engine_on = 3, False
    switch.step(0.2, 0.1)
    assert switch.thrust_acceleration == 0.0


def test_an_engine_that_comes_back_while_a_plan_is_awaited_gives_the_thrust_of_the_command_that_is_held():
    switch = CommandSwitch(source=2, engine_on=True, braking_thrust_acceleration=5.0)
    switch.initialize()
    switch.source, switch.plan_number, switch.hover_plan = 3, 4, 3
    for step, (engine_on, thrust) in enumerate([(True, 5.0), (False, 0.0), (False, 0.0), (True, 5.0)]):
        switch.engine_on = engine_on
        switch.step(0.1 * step, 0.1)
        assert switch.thrust_acceleration == thrust


def test_an_engine_that_was_off_when_the_hover_guidance_took_over_gives_the_last_command_too():
    switch = CommandSwitch(source=2, engine_on=False, braking_thrust_acceleration=5.0)
    switch.initialize()
    switch.source, switch.plan_number, switch.hover_plan, switch.engine_on = 3, 4, 3, True
    switch.step(0.0, 0.1)
    assert switch.thrust_acceleration == 5.0


def test_every_output_is_direct():
    assert all(variable.direct for variable in CommandSwitch.variables.values() if variable.causality == "output")
