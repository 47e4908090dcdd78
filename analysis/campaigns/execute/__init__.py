"""Execution of a campaign: runner, workers, shards, manifest, cluster."""
