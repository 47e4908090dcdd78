"""Tables of trials for tests of their readers."""

from perilune.analysis.campaigns.trial_columns import Column
from perilune.analysis.campaigns.trials import TrialTable

UNITS = {"metric.miss": "m", "metric.mass": "kg"}


def describe(name):
    """Return the unit of a column; one that is none of these has none."""
    return Column(UNITS.get(name, "1"), "")


def trial_table(statuses, success, metrics, draws=None):
    """Return a variant's trials from their statuses, successes and metrics, each (trials,), and samples by name."""
    columns = {f"metric.{name}": values for name, values in metrics.items()}
    columns |= {f"draw.{name}": values for name, values in (draws or {}).items()}
    return TrialTable.of({"status": statuses, "success": success, **columns}).described(describe)


def changed(trials, columns):
    """Return the trials with these columns in place of theirs; None removes one."""
    columns = {name: trials.column(name) for name in trials.names} | columns
    return TrialTable.of({name: values for name, values in columns.items() if values is not None}, trials.traces)
