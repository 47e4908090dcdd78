"""How many flights of a noisy landing missed by more than a limit: the truth beside which rare failures are set.

Of `perilune batch lunar_landing --campaign compare --compare guidance=analytic_exact_guidance --trials 200000 --output
results`, counted by `perilune.open_results("results")`: noisy parameters, which are the default, the campaign's seed.
"""

CAMPAIGN = ("lunar_landing", "compare")
GUIDANCE = "analytic_exact_guidance"
TRIALS = 140_000  # the first of them
MISSES = {3.5: 5484, 5.3: 72}  # m of position_error: how many are larger
