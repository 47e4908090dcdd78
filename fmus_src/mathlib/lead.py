"""Lead compensator in discrete time by Tustin's rule, for three axes. Kernel functions.

gain (lead s + 1)/(lag s + 1), sampled with a period T, is g' = decay g + e, m = share g + direct e:

    decay = (2 lag - T)/(2 lag + T)    direct = gain (2 lead + T)/(2 lag + T)
    share = gain ((T - 2 lead)/(2 lag + T) + decay (2 lead + T)/(2 lag + T))

Source: Franklin, Powell and Workman 1998, section 6.1.2; derivation in docs/robot_rendezvous.md.
"""

NO_STATE = 1e-12  # of the direct part: a share below it cannot carry an output


def tustin_lead(gain: float, lead: float, lag: float, period: float, law: list) -> None:
    """law[3] = decay, share, direct; times in s, not both lag and period 0."""
    divisor = 2.0 * lag + period
    law[0] = (2.0 * lag - period) / divisor
    law[2] = gain * (2.0 * lead + period) / divisor
    law[1] = gain * (period - 2.0 * lead) / divisor + law[0] * law[2]


def lead_output(law: list, g: list, e: list, m: list) -> None:
    """m[3] from the state g[3] and the input e[3]."""
    for i in range(3):
        m[i] = law[1] * g[i] + law[2] * e[i]


def advance_lead(law: list, g: list, e: list) -> None:
    """g[3] at the next tick."""
    for i in range(3):
        g[i] = law[0] * g[i] + e[i]


def change_lead(old: list, new: list, e: list, g: list) -> None:
    """g[3] with which the new law puts out for e[3] what the old one did; 0 where the new one has no state."""
    for i in range(3):
        if abs(new[1]) > NO_STATE * abs(new[2]):
            g[i] = (old[1] * g[i] + (old[2] - new[2]) * e[i]) / new[1]
        else:
            g[i] = 0.0
