"""Steps of a system compiled as one C function, from the C inside its FMUs."""
