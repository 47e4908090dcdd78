"""Numbers of trials of a noisy landing that miss by more than a limit: the truth for rare failures.

They are from `perilune batch lunar_landing --campaign compare --compare guidance=analytic_exact_guidance --trials
200000 --output results`, counted by `perilune.open_results("results")`, with noisy parameters, the default, and the
campaign's seed.
"""

CAMPAIGN = ("lunar_landing", "compare")
GUIDANCE = "analytic_exact_guidance"
TRIALS = 200_000
MISSES = {3.5: 7877, 5.3: 108}  # m of position_error: how many are larger
