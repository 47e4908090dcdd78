"""Export of blocks as FMUs and of system folders as .ssp files."""
