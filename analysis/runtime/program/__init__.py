"""The meaning of a simulation's steps, written to be read: the contract that every executor keeps to the bit."""
