"""Execution of campaigns on other machines, by the workers of a dask.distributed cluster."""
