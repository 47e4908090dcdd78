"""Gravity of the Moon, landing sites and descent guidance. Kernel functions."""
