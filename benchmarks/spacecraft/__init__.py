"""What the plant `spacecraft` costs, alone and in a system."""
