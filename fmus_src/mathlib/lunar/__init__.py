"""Moon, landing sites and terminal guidance. Kernel functions."""
