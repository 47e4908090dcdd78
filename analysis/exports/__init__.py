"""What `perilune export` writes: FMUs, systems with their FMUs inside, the blocks of a file."""
