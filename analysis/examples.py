"""An example or two of every verb, for `perilune VERB --help` and for the site; a test runs each, in this order.

No import, so that `perilune --help` stays light.
"""

from __future__ import annotations

# Verb -> (command, what comes of it). A command may use what those above it wrote.
EXAMPLES: dict[str, tuple[tuple[str, str], ...]] = {
    "list": (("perilune list", "names to give to the other verbs"),),
    "describe": (
        ("perilune describe lunar_landing", "components, connections, values, what fits where"),
        ("perilune describe lunar_landing guidance", "one component with all that it has"),
        ("perilune describe terminal_guidance", "a slot: connectors, parameters, the FMUs for it"),
    ),
    "validate": (
        ("perilune validate lunar_landing", "a system; a folder, .ssp, .fmu, .ssv or campaign .toml likewise"),
    ),
    "run": (
        ("perilune run lunar_terminal_guidance --report flight.html", "one landing and its page"),
        (
            "perilune run lunar_landing --use guidance=astar_guidance --parameters ideal.ssv --output flight.csv",
            "another guidance, no sensor errors; all signals to a file",
        ),
        ("perilune run lunar_terminal_guidance --require 'time < 300'", "exit status 1 if it takes longer"),
        ("perilune export flat_moon_lander", "an FMU, as any other tool writes them"),
        (
            "perilune run flat_moon_lander.fmu --stop-time 20 --log warning --timeout 60 --output lander.csv",
            "it flies alone, with what it says on standard error, for a minute of yours at most",
        ),
    ),
    "batch": (
        (
            "perilune batch lunar_terminal_guidance --campaign paper --trials 50 --output results --report batch.html",
            "three guidances on the same fifty draws",
        ),
        (
            "perilune batch lunar_terminal_guidance --campaign paper --replay 7 --output replay",
            "one trial again, with all signals",
        ),
        (
            "perilune batch lunar_terminal_guidance --campaign paper --compare guidance=analytic_guidance "
            "--sensitivity 64",
            "which draws drive the metrics",
        ),
    ),
    "shard": (
        (
            "perilune batch lunar_terminal_guidance --campaign paper --trials 100 --output parts --prepare",
            "what flies, written down",
        ),
        ("perilune shard parts 0-2", "three of its four shards, here or on another machine"),
        ("perilune shard parts 3", "the last one"),
    ),
    "replay": (
        (
            "perilune batch lunar_terminal_guidance --campaign paper --trials 30 --output landings",
            "a campaign in a folder",
        ),
        (
            "perilune replay landings 7 --configuration analytic_guidance --report trial_7.html",
            "one of its trials, to the last bit, with all signals on a page",
        ),
    ),
    "merge": (
        (
            "perilune batch lunar_terminal_guidance --campaign paper --trials 50 --output shared --prepare",
            "what flies, written down",
        ),
        ("perilune shard shared 0-1", "both of its shards, on one machine or another"),
        ("perilune merge shared --report merged.html", "their result"),
    ),
    "rare": (
        (
            "perilune rare lunar_terminal_guidance --campaign paper --compare guidance=analytic_guidance "
            "--failure 'flight_time > 220' --samples 500 --output long_flights",
            "how likely a long flight is, by few flights a level",
        ),
        (
            "perilune batch lunar_terminal_guidance --campaign paper --compare guidance=analytic_guidance "
            "--draws long_flights/failures.parquet",
            "the most probable long flights again",
        ),
    ),
    "worst": (
        (
            "perilune worst lunar_terminal_guidance --campaign paper --compare guidance=analytic_guidance "
            "--metric flight_time --flights 600 --output longest",
            "the longest flight from anywhere in the box",
        ),
    ),
    "compare": (
        ("perilune batch lunar_terminal_guidance --campaign paper --trials 50 --output results", "what is compared"),
        ("perilune compare results --report compare.html", "rates, pairs of variants, trajectories, distributions"),
    ),
    "law": (
        ("perilune law diveev_2013", "the published law as a formula"),
        ("perilune law diveev_2013 --output law.ssv --graph law.svg", "a parameter set that flies it, and its drawing"),
    ),
    "synthesize": (
        (
            "perilune synthesize network-operator lunar_landing_5_deg_s --output laws",
            "over at once: the published law keeps all nine starts",
        ),
    ),
    "plan": (
        ("perilune plan hover-transfer --margins", "from hover to hover, with margins for control"),
        ("perilune plan landing-bound", "what no landing from there can beat; needs the extra plan"),
    ),
    "stability": (
        (
            "perilune stability robot_rendezvous --loop attitude --parameters paper.ssv --report stability.html",
            "one of the loops that the system declares",
        ),
        (
            "perilune stability lunar_terminal_guidance --loop guidance.thrust_acceleration --at 20",
            "a connector cut at a time, in a system that declares none",
        ),
    ),
    "benchmark": (("perilune benchmark --steps 500 --repeats 2", "a shorter run than the default"),),
    "new": (
        ("perilune new block my_guidance --slot terminal_guidance", "my_guidance.py, which flies as it is"),
        ("perilune new system my_axis", "a folder with plant, controller, description, campaign, loop"),
    ),
    "export": (
        ("perilune export forming_filter --platform linux64", "forming_filter.fmu"),
        (
            "perilune export lunar_terminal_guidance --flavour python --output landing.ssp",
            "a system with its FMUs inside",
        ),
    ),
}
