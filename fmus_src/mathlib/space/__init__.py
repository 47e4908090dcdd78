"""Space environment: gravity, magnetic field, Sun and Moon, planet axes, air, sunlight. Kernel functions."""
