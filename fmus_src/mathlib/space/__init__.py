"""Environment of a spacecraft: gravity, magnetic field, Sun and Moon, axes of planets, air, light. Kernel functions."""
