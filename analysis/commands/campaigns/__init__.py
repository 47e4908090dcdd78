"""The commands about campaigns: flown, in one go or in shards, put together, and what else their draws tell."""
