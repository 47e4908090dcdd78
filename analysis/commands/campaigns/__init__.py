"""The commands about campaigns: flown, in one go or in shards, and put together."""
