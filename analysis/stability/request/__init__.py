"""Request for a stability study: declarations in the SSD, options, channels of the cuts."""
