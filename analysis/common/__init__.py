"""What all rooms use: errors, atomic files, progress, percentages, output streams."""
