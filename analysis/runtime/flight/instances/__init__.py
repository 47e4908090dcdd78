"""One FMU at run time: its library, its instances, whether its reset can be trusted."""
