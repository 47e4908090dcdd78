"""In which order components are stepped and initialised, and what of their feedthrough is declared or assumed."""
