"""The ways of flying a system that the benchmark times: ours, other importers, the limit."""
