"""Steps of a system compiled as one C function, from the C code inside its FMUs."""
