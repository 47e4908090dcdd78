"""What a stability study is asked: declarations in the SSD, options, channels of the cuts."""
